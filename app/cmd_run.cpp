// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/run_session/run_session.h"
#include "option_checks.h"
#include "progress.h"
#include "signals.h"
#include "source_options.h"
#include "view_window.h"

namespace edgevo::app {
namespace {

struct RunArguments {
  RunRequest run;
  std::string params_file, detector, edge_model, edge_folder, edge_map, loops, mask, mcap = "poses";
  std::vector<std::string> settings;
  bool view = false;
};

bool parse_on_off(const std::string& text, const std::string& option) {
  if (text == "on" || text == "off") return text == "on";
  throw InputError(option + " " + text, "is neither on nor off", "give one of them");
}

RunParams effective_params(const RunArguments& args) {
  RunParams params;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  if (!args.params_file.empty()) read_params_given(args.params_file, visit, args.run.quiet);
  for (const std::string& setting : args.settings) set_param(setting, visit);
  if (!args.detector.empty()) set_param("edges.detector=" + args.detector, visit);
  if (!args.edge_model.empty()) params.odometry.edges.model = args.edge_model;
  if (!args.edge_folder.empty()) params.odometry.edges.folder = args.edge_folder;
  if (!args.mask.empty()) params.odometry.edges.mask = args.mask;
  if (!args.loops.empty()) params.places.loops = parse_on_off(args.loops, "--loops");
  if (!args.edge_map.empty()) set_param("edge_map.mode=" + args.edge_map, visit);
  return params;
}

OnBadFrame parse_on_bad_frame(const std::string& text) {
  if (text == "skip") return OnBadFrame::kSkip;
  if (text == "stop") return OnBadFrame::kStop;
  throw InputError("--on-bad-frame " + text, "is neither stop nor skip", "give one of them");
}

RunHost run_host(bool with_window) {
  RunHost host;
  host.listen_to_signals = listen_to_signals;
  host.stop = interrupted;
  host.print = [](const std::string& line) { std::printf("%s\n", line.c_str()); };
  host.warn = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  host.progress = [](const std::string& what, std::optional<int> total) -> ProgressDisplay {
    const auto line = std::make_shared<Progress>(what, total);
    return {[line](int done) { line->update(done); }, [line](const std::string& text) { line->say(text); }};
  };
  if (with_window)
    host.open_window = [](const auto& T_vehicle_cam, std::shared_ptr<MapLog> log, std::string* why) {
      return open_view_window(T_vehicle_cam, std::move(log), interrupted, why);
    };
  return host;
}

int run(const RunArguments& args) {
  constexpr int kDone = 0, kMostlyFailed = 3;
  if (args.view) become_program_with_window(args.run.command_line);
  RunRequest request = args.run;
  request.params = effective_params(args);
  request.outputs.mcap = parse_mcap_content(args.mcap, "--mcap " + args.mcap);
  return run_session(request, run_host(args.view)) ? kDone : kMostlyFailed;
}

}  // namespace

void add_run_command(CLI::App& app, Action* action, std::vector<std::string> command_line) {
  CLI::App* command = app.add_subcommand("run", "run the odometry on a source: trajectory and edge map");
  auto args = std::make_shared<RunArguments>();
  args->run.command_line = std::move(command_line);
  add_source_options(*command, &args->run.source);
  add_mount(*command, &args->run.source.mount);
  add_image_scale(*command, &args->run.source);
  add_rectification(*command, &args->run.target);
  command
      ->add_option("-o,--out", args->run.out,
                   "folder for the results, created if missing; an earlier run in it is kept until this one "
                   "has a pose")
      ->required()
      ->check(path_given());
  command->add_option("--params", args->params_file,
                      "YAML file of parameters (edgevo help parameters), or summary.yaml of a run; others "
                      "keep their defaults");
  command
      ->add_option("--set", args->settings,
                   "set a parameter (edgevo help parameters), GROUP.KEY=VALUE; repeatable")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--detector", args->detector,
                      "edge detector: " + edge_detector_help(all_edge_detectors()));
  command
      ->add_option("--edge-model", args->edge_model,
                   "model for the detectors structured (a forest in OpenCV's format) and network (an .onnx "
                   "with its .yaml next to it), instead of the one shipped with edgevo")
      ->check(path_given());
  command
      ->add_option("--mask", args->mask,
                   "PNG of the shape of the images: what is black or transparent there, such as a part of "
                   "the vehicle, is left out")
      ->check(path_given());
  command
      ->add_option("--edge-folder", args->edge_folder,
                   "folder written by `edgevo edges`, for the detector precomputed")
      ->check(path_given());
  command->add_option(
      "--edge-map", args->edge_map,
      "edge lines besides the points: off, keyframes (per keyframe), full (each 3D edge once; default)");
  CLI::Option* map =
      command
          ->add_option(
              "--map", args->run.map,
              "map that an earlier run has kept (its folder, or map.db in it): the run gets its frame and "
              "unit where its places are recognised; it is not changed without --extend")
          ->check(path_given());
  command
      ->add_flag("--extend", args->run.extend_map,
                 "with --map, add to the map what it does not have: views of other places, and of its own in "
                 "other light")
      ->needs(map);
  command->add_option("--loops", args->loops,
                      "recognise places seen before, correct the map by them, and keep it in map.db: on "
                      "(default) or off; off "
                      "with --forget");
  command
      ->add_option("--seed", args->run.seed,
                   "seed of all random numbers; synchronous runs with the same seed are bit-identical")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()));
  command->add_option(
      "--scale", args->run.scale,
      "source of metric scale: none (arbitrary unit), factor=METRES_PER_UNIT, or one or several, separated "
      "by "
      "commas, of odometry, gps, robot_pose (from the rawlog) and camera_height=METRES (above the ground)");
  CLI::Option* realtime =
      command->add_flag("--realtime", args->run.realtime,
                        "run tracking and mapping in two threads and measure latencies; not bit-identical");
  command
      ->add_option_function<std::string>(
          "--pace", [args](const std::string& text) { args->run.pace = parse_pace(text); },
          "with --realtime, playback rate of a recording: 30 (frames per second), 1x (by its timestamps), "
          "0.5x (half speed); default: each frame as soon as the previous one is done")
      ->needs(realtime);
  command
      ->add_option("--trace", args->run.trace,
                   "file for a trace of the run: what each thread did, and when (Chrome's trace format)")
      ->check(path_given());
  command->add_flag("--view", args->view,
                    "show edges and map in a window; space pauses, s steps, c changes colours, f follows the "
                    "camera, q ends "
                    "the run");
  command->add_option_function<std::string>(
      "--on-bad-frame",
      [args](const std::string& text) { args->run.on_bad_frame = parse_on_bad_frame(text); },
      "unusable image or time: skip (default) continues as if the camera had dropped the frame and notes it "
      "in frames.csv and summary.yaml; stop ends the run there with all results so far. The first image must "
      "be usable either way");
  command->add_flag("--forget", args->run.outputs.forget,
                    "for runs of any length: what is on disk leaves the memory; `edgevo finish OUT` writes "
                    "final poses and maps");
  command->add_flag("--priority", args->run.prioritise,
                    "give tracking the real-time priority of the system (SCHED_FIFO), where that is allowed");
  command->add_flag("--copy-images", args->run.outputs.copy_images,
                    "copy the images of the playback instead of linking them, so that OUT is self-contained");
  command->add_option(
      "--mcap", args->mcap,
      "run.mcap for Foxglove, RViz and ROS 2: poses (the default; 2 MB a minute at most), images "
      "(with the edges drawn, too), off");
  add_include_doubtful(*command, &args->run.outputs.include_doubtful);
  command->add_flag("--force", args->run.outputs.force,
                    "write into a folder that holds other files or an interrupted run");
  command->add_flag("--quiet", args->run.quiet, "print nothing but errors");
  command->footer(
      "Ctrl-C ends the run with all results so far; the exit code is the same as at the end of the source. "
      "`edgevo finish OUT` writes the results of a run that was killed.");
  command->callback([=] { *action = [=] { return run(*args); }; });
}

}  // namespace edgevo::app
