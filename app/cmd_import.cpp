// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "commands.h"
#include "edgevo/sequence_output/derived_sequence.h"
#include "option_checks.h"
#include "sequence_host.h"
#include "source_options.h"

namespace edgevo::app {

void add_import_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand("import", "convert a source to an MRPT rawlog with external images");
  auto args = std::make_shared<ImportRequest>();
  add_source_options(*command, &args->source);
  add_mount(*command, &args->source.mount);
  command->add_option("-o,OUT.rawlog", args->out, "rawlog to write; its images go to OUT_Images")->required();
  add_force(*command, &args->force);
  command->callback([=] { *action = [=] { return write_imported(*args, sequence_host()), 0; }; });
}

}  // namespace edgevo::app
