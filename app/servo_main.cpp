// SPDX-License-Identifier: BSD-3-Clause
// edgevo-servo: the program behind `edgevo servo`. It is separate because it links ViSP and is therefore
// distributed under the GPL (see LICENSE), which `edgevo` is not.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <opencv2/core/utility.hpp>

#include "edgevo/core/error.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/servo/closed_loop.h"
#include "edgevo/servo/kept_goal.h"
#include "edgevo/servo/servo_outputs.h"
#include "edgevo/simulation/relight.h"
#include "edgevo/visp_bridge/servo_params.h"
#include "option_checks.h"
#include "progress.h"
#include "signals.h"

namespace edgevo::app {
namespace {

constexpr int kDone = 0, kBadInput = 2, kNotConverged = 3;

struct Options {
  std::string out, params_file, latency = "measured";
  std::vector<std::string> settings;
  ServoParams servo;
  bool quiet = false, force = false;
  std::vector<std::string> command_line;
};

void add_options(CLI::App& app, Options* o) {
  ServoParams& s = o->servo;
  app.add_option("-o,--out", o->out, "folder for the results, created if missing")
      ->required()
      ->check(path_given());
  app.add_option("--law", s.law, "control law: pbvs (to the taught pose) or ibvs (on the tracked points)")
      ->check(CLI::IsMember({"pbvs", "ibvs"}));
  app.add_option("--scale-error", s.scale_error,
                 "factor between the metres of the odometry and true metres (default 1)")
      ->check(number_between(0.05, 20));
  app.add_option("--light", s.light,
                 "lighting change during the motion: a kind of `edgevo relight`, for example mixed");
  app.add_option("--blackout", s.blackout_s, "seconds of darkness, starting 1.5 s after the loop")
      ->check(number_between(0, 60));
  app.add_flag("--carried", s.is_carried,
               "with --map and --blackout, carry the camera back to the start while it is dark");
  app.add_option(
         "--map", s.map,
         "folder of an earlier `edgevo servo`: steer to the pose that was taught there, by its map; the "
         "camera is moved by hand until it is found in that")
      ->check(path_given());
  app.add_option(
      "--latency", o->latency,
      "latency of the odometry per image: measured (default), cpu (its CPU time, for a machine busy "
      "with other work), or a number of seconds, which makes runs bit-identical");
  app.add_option("--rate", s.rate_hz, "images and commands per second (default 20)")
      ->check(number_between(1, 200));
  app.add_option("--gain", s.gain, "gain lambda of the control law, 1/s (default 1)")
      ->check(number_between(0.05, 10));
  app.add_option("--points", s.points, "number of edge points for the control law (default 20)")
      ->check(whole_number(4, 500));
  app.add_option("--limit", s.limit_s, "time limit of the loop, seconds (default 25)")
      ->check(number_between(1, 600));
  app.add_option("--seed", s.seed, "seed of the odometry, the lighting and the start pose (default 1)")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()));
  app.add_option("--params", o->params_file,
                 "YAML file of odometry parameters, applied on top of params/servo.yaml");
  app.add_option("--set", o->settings, "set a parameter of the odometry, GROUP.KEY=VALUE; repeatable")
      ->take_all()
      ->allow_extra_args(false);
  add_force(app, &o->force);
  app.add_flag("--quiet", o->quiet, "print nothing but errors");
}

OdometryParams odometry_params(const Options& o) {
  OdometryParams params = servo_odometry_params();
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  if (!o.params_file.empty()) read_params_given(o.params_file, visit);
  for (const std::string& setting : o.settings) set_param(setting, visit);
  return params;
}

void set_latency(const std::string& text, ServoParams* params) {
  if (text == "measured") return;
  if ((params->cpu_latency = text == "cpu")) return;
  Timestamp latency;
  if (!parse_seconds(text, &latency) || latency.ticks < 0 || latency.seconds() > 2)
    throw InputError("--latency " + text, "is neither 'measured' nor 'cpu' nor seconds from 0 to 2",
                     "give for example --latency 0.05");
  params->latency_s = latency.seconds();
}

void check_light(const std::string& kind) {
  const std::vector<std::string>& kinds = relight_kinds();
  if (kind.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
  std::string known;
  for (const std::string& k : kinds) known += (known.empty() ? "" : ", ") + k;
  throw InputError("--light " + kind, "is not a kind of lighting change",
                   "did you mean " + nearest_name(kind, kinds) + "? known are " + known);
}

void check_map(const ServoParams& servo, const std::string& out) {
  if (servo.is_carried && servo.map.empty())
    throw InputError("--carried", "is for a goal that was kept", "give --map, too");
  if (servo.is_carried && !(servo.blackout_s > 0))
    throw InputError("--carried", "is for a camera in darkness", "give --blackout, too");
  if (servo.map.empty()) return;
  if (servo.law != "pbvs")
    throw InputError("--law " + servo.law, "steers by points that were taught in the same loop",
                     "omit --law or --map");
  std::error_code ignored;
  if (std::filesystem::equivalent(servo.map, out, ignored))
    throw InputError("--map " + servo.map, "is the folder for the results, too", "give another -o");
}

int servo(Options o) {
  set_latency(o.latency, &o.servo);
  check_light(o.servo.light);
  check_map(o.servo, o.out);
  OdometryParams params = odometry_params(o);
  check_folder_is_ours(o.out, {"servo.csv"}, o.force);
  if (!o.servo.map.empty()) read_kept_goal(o.servo.map);
  RunFolder folder(o.out);
  listen_to_signals();
  ServoRunInfo info{o.servo, write_params([&](ParamVisitor& v) { params.visit(v); }, 2), o.command_line};
  ServoResult result;
  {
    std::optional<Progress> progress;
    if (!o.quiet) progress.emplace(o.servo.law, std::nullopt);
    int images = 0;
    result = run_closed_loop(o.servo, params, [&](double) {
      if (progress) progress->update(++images);
      return !interrupted();
    });
  }
  write_servo_outputs(result, info, &folder);
  if (!result.failure.empty()) {
    std::fprintf(stderr, "edgevo: the servo loop did not start: %s; see %s/report.html\n",
                 result.failure.c_str(), o.out.c_str());
    return kNotConverged;
  }
  const LatencyFigures latency = latency_figures(result);
  if (!o.quiet)
    std::printf(
        "%s: %s; ended %.2f mm, %.3f deg, %.2f px from the taught view (started %.0f mm, %.1f deg, %.0f px "
        "away)\n"
        "%.1f s, latency %.0f ms (median), %.0f ms (95 %%); stopped %d time(s), %.2f s\nresults in %s "
        "(report.html)\n",
        o.servo.law.c_str(), result.converged ? "converged" : "NOT converged", result.final_mm,
        result.final_deg, result.final_px, result.start_mm, result.start_deg, result.start_px,
        result.rows.back().time_s, latency.p50, latency.p95, result.stops, result.stopped_s, o.out.c_str());
  return result.converged ? kDone : kNotConverged;
}

int report(const std::string& message) {
  std::fprintf(stderr, "edgevo: %s\n", message.c_str());
  return kBadInput;
}

}  // namespace
}  // namespace edgevo::app

int main(int argc, char** argv) {
  using namespace edgevo::app;
  CLI::App app("The part of edgevo that links ViSP; called by edgevo.");
  app.name("edgevo");
  app.require_subcommand(1);
  CLI::App* command =
      app.add_subcommand("servo",
                         "simulate visual servoing: a camera over a rendered desk, controlled by ViSP's "
                         "control laws, with the odometry as the only sensor");
  command->footer("Exit codes: 0 converged; 2 bad usage or bad input; 3 not converged, or not started.");
  Options options;
  options.command_line.assign(argv, argv + argc);
  add_options(*command, &options);
  try {
    app.parse(argc, argv);
    cv::setNumThreads(1);  // the latency is that of a single thread
    return servo(options);
  } catch (const CLI::CallForHelp& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return report(explain(app, e, argc, argv));
  } catch (const edgevo::InputError& e) {
    return report(e.what());
  } catch (const std::bad_alloc&) {
    return report("out of memory; close other programs and try again");
  } catch (const std::exception& e) {
    return report(e.what());
  }
}
