// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/results/rawlog_output.h"
#include "option_checks.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

struct ImportArguments {
  SourceOptions source;
  std::string rawlog;
  bool force = false;
};

void check_output(const ImportArguments& args) {
  if (!names_rawlog(args.rawlog))
    throw InputError(args.rawlog, "does not end in .rawlog",
                     "name the output OUT.rawlog, so that the MRPT tools recognise it");
  check_sequence_output(args.source.path, args.rawlog, args.force);
}

int import(const ImportArguments& args) {
  check_output(args);
  const auto source = open_source_with_notices(args.source);
  const std::string truth = ground_truth_tum(args.source, *source);
  int count = 0;
  {
    Progress progress("importing", source->size());
    count = write_rawlog(*source, args.rawlog, truth, [&](int done) { progress.update(done); });
  }
  std::printf("%s\n", describe_rawlog(args.rawlog, count, !truth.empty(), source->camera()).c_str());
  return 0;
}

}  // namespace

void add_import_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand("import", "convert a source to an MRPT rawlog with external images");
  auto args = std::make_shared<ImportArguments>();
  add_source_options(*command, &args->source);
  add_mount(*command, &args->source.mount);
  command->add_option("OUT.rawlog", args->rawlog, "rawlog to write; its images go to OUT_Images")->required();
  add_force(*command, &args->force);
  command->callback([=] { *action = [=] { return import(*args); }; });
}

}  // namespace edgevo::app
