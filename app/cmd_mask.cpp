// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

// As of grep: a script that goes on with the mask must know that there is none.
constexpr int kNothingFound = 1;

struct MaskCommand {
  std::string run, out;
  bool force = false;
};

int copy_mask(const MaskCommand& options) {
  namespace fs = std::filesystem;
  const fs::path found = fs::path(options.run) / "mask.png";
  std::error_code error;
  if (!fs::exists(fs::path(options.run) / "summary.yaml", error))
    throw InputError(options.run, "is not the folder of a finished run", "give the -o of `edgevo run`");
  if (!fs::exists(found, error)) {
    std::fprintf(stderr, "%s: nothing fixed to the camera was found; no mask is written\n",
                 options.run.c_str());
    return kNothingFound;
  }
  if (!options.force && fs::exists(options.out, error))
    throw InputError(options.out, "exists already", "give another name, or --force to replace it");
  fs::copy_file(found, options.out, fs::copy_options::overwrite_existing, error);
  if (error) throw InputError(options.out, "cannot be written: " + error.message(), "give another name");
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
  command->callback([=] { *action = [=] { return copy_mask(*options); }; });
}

}  // namespace edgevo::app
