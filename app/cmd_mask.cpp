// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/results/run_mask.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

// As of grep: a script that goes on with the mask must know that there is none.
constexpr int kNothingFound = 1;

struct MaskCommand {
  std::string run, out;
  bool force = false;
};

int mask(const MaskCommand& options) {
  if (!copy_run_mask(options.run, options.out, options.force)) {
    std::fprintf(stderr, "%s: nothing fixed to the camera was found; no mask is written\n",
                 options.run.c_str());
    return kNothingFound;
  }
  std::printf("%s: black gives no edges; `edgevo run SOURCE --mask %s`\n", options.out.c_str(),
              options.out.c_str());
  return 0;
}

}  // namespace

void add_mask_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "mask", "write the mask of what a run found to be fixed to the camera, for `edgevo run --mask`");
  auto options = std::make_shared<MaskCommand>();
  command->add_option("RUN", options->run, "output folder of a run")->required()->check(path_given());
  command->add_option("-o,--out", options->out, "PNG to write")->required()->check(path_given());
  add_force(*command, &options->force);
  command->footer(
      "Exit codes: 0 written; 1 the run found nothing that is fixed to the camera, nothing is written; 2 bad "
      "usage or input.");
  command->callback([=] { *action = [=] { return mask(*options); }; });
}

}  // namespace edgevo::app
