// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/results/recover_run.h"
#include "option_checks.h"
#include "print_run.h"

namespace edgevo::app {
namespace {

int finish(const std::string& out) {
  const Run run = recover_run(out);
  print_run(run, out);
  if (!run.scale.problem.empty())
    throw InputError(out, "the results are in an arbitrary unit", run.scale.problem);
  return 0;
}

}  // namespace

void add_finish_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "finish", "write the results of an interrupted run (killed, power loss), as far as it got");
  auto out = std::make_shared<std::string>();
  command->add_option("OUT", *out, "output folder of the interrupted run")->required()->check(path_given());
  command->callback([=] { *action = [=] { return finish(*out); }; });
}

}  // namespace edgevo::app
