#pragma once
// `edgevo help COMMAND` says what `edgevo COMMAND --help` says.
#include <CLI/CLI.hpp>
#include <vector>

namespace edgevo::app {

/// Lists `help` among the sub-commands.
void add_help_command(CLI::App& app);

/// The words of the command line, `help COMMAND ...` as `COMMAND --help` and a lone `help` as `--help`; what
/// is no sub-command of `app` stands alone, and is refused as such. They point into `argv`.
std::vector<char*> help_as_option(const CLI::App& app, int argc, char** argv);

}  // namespace edgevo::app
