// SPDX-License-Identifier: BSD-3-Clause
// edgevo-commands: the program that replaces `edgevo` (front_main.cpp) for everything that it does not do
// itself.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <opencv2/core/utility.hpp>

#include "commands.h"
#include "edgevo/benchmark/evaluated_runs.h"
#include "edgevo/benchmark/source_truth.h"
#include "edgevo/core/error.h"
#include "help.h"
#include "help_parameters.h"
#include "option_checks.h"
#include "standard_output.h"
#include "version.h"

namespace {

constexpr int kBadInput = 2;

int report(const char* message) {
  std::fprintf(stderr, "edgevo: %s\n", message);
  return kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  edgevo::app::print_line_by_line();
  CLI::App app(
      "Monocular edge visual odometry: computes a trajectory and an edge map from the images of one moving "
      "camera.");
  app.name("edgevo");
  app.require_subcommand(1);
  app.set_version_flag("--version", edgevo::app::version_text());
  edgevo::app::Action action;
  edgevo::app::add_run_command(app, &action, std::vector<std::string>(argv, argv + argc));
  edgevo::app::add_finish_command(app, &action);
  edgevo::app::add_import_command(app, &action);
  edgevo::app::add_info_command(app, &action);
  edgevo::app::add_mask_command(app, &action);
  edgevo::app::add_eval_command(
      app, &action, edgevo::source_truth,
      [](const edgevo::RunEvaluationRequest& request) {
        std::fputs(edgevo::evaluate_runs(request).c_str(), stdout);
        return 0;
      },
      edgevo::app::eval_map);
  edgevo::app::add_simulate_command(app, &action);
  edgevo::app::add_relight_command(app, &action);
  edgevo::app::add_overlay_command(app, &action);
  edgevo::app::add_edges_command(app, &action);
  edgevo::app::add_study_command(app, &action);
  edgevo::app::add_calibrate_command(app, &action);
  edgevo::app::add_map_command(app, &action);
  edgevo::app::add_join_command(app, &action);
  edgevo::app::add_bench_command(app, &action);
  edgevo::app::add_table_command(app, &action);
  edgevo::app::add_compare_command(app, &action);
  edgevo::app::add_servo_command(app, &action);
  edgevo::app::add_help_command(app);
  app.footer(
      "Exit codes: 0 done; 1 nothing found (`mask`); 2 bad usage or bad input; 3 finished, but tracking "
      "failed for most of the sequence, or more than a quarter of its poses are doubtful or in a place that "
      "is a guess.");
  std::vector<char*> words = edgevo::app::help_as_option(app, argc, argv);
  try {
    if (argc == 3 && std::string(argv[1]) == "--write-help") {  // for the build
      edgevo::app::write_help(app, argv[2]);
      edgevo::app::write_parameters_help(argv[2]);
      return 0;
    }
    if (edgevo::app::print_parameters_help(argc, argv)) return edgevo::app::end_of_output(0);
    app.parse(int(words.size()), words.data());
    cv::setNumThreads(1);  // tracking, mapping and several runs at a time have threads of their own
    return edgevo::app::end_of_output(action());
  } catch (const CLI::CallForHelp& e) {
    return edgevo::app::end_of_output(app.exit(e));
  } catch (const CLI::CallForVersion& e) {
    return edgevo::app::end_of_output(app.exit(e));
  } catch (const CLI::ParseError& e) {
    return report(edgevo::app::explain(app, e, int(words.size()), words.data()).c_str());
  } catch (const edgevo::InputError& e) {
    return report(e.what());
  } catch (const std::bad_alloc&) {
    return report("out of memory; use smaller images or fewer frames (--frames A:B)");
  } catch (const std::exception& e) {
    return report(e.what());
  }
}
