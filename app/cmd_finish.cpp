#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/results/cut_off_run.h"
#include "option_checks.h"
#include "print_run.h"

namespace edgevo::app {
namespace {

int finish(const std::string& out) {
  const Run run = finish_cut_off_run(out);
  print_run(run, out);
  if (!run.scale.problem.empty())
    throw InputError(out, "the results are in an arbitrary unit", run.scale.problem);
  return 0;
}

}  // namespace

void add_finish_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "finish", "the results of a run that was cut off (killed, no power), as far as it came");
  auto out = std::make_shared<std::string>();
  command->add_option("OUT", *out, "the folder that the run was writing to")->required()->check(path_given());
  command->callback([=] { *action = [=] { return finish(*out); }; });
}

}  // namespace edgevo::app
