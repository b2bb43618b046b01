// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "commands.h"
#include "edgevo/sequence_output/derived_sequence.h"
#include "edgevo/simulation/relight.h"
#include "option_checks.h"
#include "sequence_host.h"
#include "source_options.h"

namespace edgevo::app {

void add_relight_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "relight", "write a copy of a source under changed lighting, as a folder or a rawlog");
  auto options = std::make_shared<RelightRequest>();
  add_source_options(*command, &options->source);
  std::string kinds;
  for (const std::string& kind : relight_kinds()) kinds += (kinds.empty() ? "" : ", ") + kind;
  command->add_option("-o,--out", options->out, "folder or OUT.rawlog to write")
      ->required()
      ->check(path_given());
  command->add_option("--kind", options->kind, "kind of lighting change: " + kinds)->capture_default_str();
  command->add_option("--seed", options->seed, "seed of the lighting changes")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()))
      ->capture_default_str();
  add_force(*command, &options->force);
  command->callback([=] { *action = [=] { return write_relit(*options, sequence_host()), 0; }; });
}

}  // namespace edgevo::app
