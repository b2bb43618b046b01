// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/results/recover_run.h"
#include "edgevo/results/recovery_log.h"
#include "edgevo/run_quality/closing_lines.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

int finish(const std::string& out, const RecoveryOptions& options) {
  const RecoveredRun recovered = recover_run(out, options);
  const Run& run = recovered.run;
  if (!recovered.map_note.empty()) std::fprintf(stderr, "%s\n", recovered.map_note.c_str());
  for (const ClosingLine& line : closing_lines(run, out, options.include_doubtful))
    std::fprintf(line.is_warning ? stderr : stdout, "%s\n", line.text.c_str());
  if (!recovered.mcap_note.empty()) std::fprintf(stderr, "%s\n", recovered.mcap_note.c_str());
  if (recovered.is_damaged)
    throw InputError(
        out,
        "its recovery log is damaged: " + std::to_string(run.frames.size()) + " of " +
            std::to_string(run.frames.size() + size_t(recovered.frames_lost)) + " frames were recovered",
        "the results end there, and the log (" + std::string(kRecoveryLog) +
            ") is kept; restore it from a copy and finish again, or run the sequence again with --force");
  if (!run.scale.problem.empty())
    throw InputError(out, "the results are in an arbitrary unit", run.scale.problem);
  constexpr int kDone = 0, kMostlyFailed = 3;
  const std::optional<std::string> failure = failure_statement(run, out);
  if (failure) std::fprintf(stderr, "edgevo: %s\n", failure->c_str());
  return failure ? kMostlyFailed : kDone;
}

}  // namespace

void add_finish_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "finish", "write the results of an interrupted run (killed, power loss), as far as it got");
  auto out = std::make_shared<std::string>();
  command->add_option("OUT", *out, "output folder of the interrupted run")->required()->check(path_given());
  auto options = std::make_shared<RecoveryOptions>();
  add_include_doubtful(*command, &options->include_doubtful);
  command
      ->add_option("--resolution", options->resolution,
                   "size of voxels and cells, unit of the run (default: that of the run)")
      ->check(positive_number());
  auto mcap = std::make_shared<std::string>();
  command->add_option(
      "--mcap", *mcap,
      "run.mcap: poses or off (default: poses; what has images stays as it is, without its end)");
  command->footer("The exit code is that of a run that ended there.");
  command->callback([=] {
    *action = [=] {
      if (!mcap->empty()) options->mcap = parse_mcap_content(*mcap, "--mcap " + *mcap);
      return finish(*out, *options);
    };
  });
}

}  // namespace edgevo::app
