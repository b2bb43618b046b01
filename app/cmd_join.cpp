// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/kept_map/map_join.h"
#include "option_checks.h"

namespace edgevo::app {

void add_join_command(CLI::App& app, Action* action) {
  CLI::App* command =
      app.add_subcommand("join", "join the maps of two runs (map.db) where they show the same places");
  struct Arguments {
    std::string first, second, out;
  };
  auto args = std::make_shared<Arguments>();
  command
      ->add_option("FIRST", args->first,
                   "map of a run (its folder, or map.db in it): the result has its frame and unit")
      ->required()
      ->check(path_given());
  command->add_option("SECOND", args->second, "another one, of the same camera")
      ->required()
      ->check(path_given());
  command->add_option("-o,--out", args->out, "file to write; it must not be there yet")
      ->required()
      ->check(path_given());
  command->footer("The result is for `edgevo run --map` and `edgevo info`. Neither map is changed.");
  command->callback([=] {
    *action = [=] {
      const JoinedMaps joined = join_map_files(args->first, args->second, args->out);
      for (const std::string& line : joined.warnings) std::fprintf(stderr, "edgevo: %s\n", line.c_str());
      std::printf("%s: %s\n", args->out.c_str(), joined.statement.c_str());
      return 0;
    };
  });
}

}  // namespace edgevo::app
