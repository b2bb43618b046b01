#pragma once
// `edgevo help COMMAND` says what `edgevo COMMAND --help` says.
#include <CLI/CLI.hpp>
#include <vector>

namespace edgevo::app {

/// Lists `help` among the sub-commands.
void add_help_command(CLI::App& app);

/// The words of the command line, `help COMMAND ...` as `COMMAND --help` and a lone `help` as `--help`. They
/// point into `argv`.
std::vector<char*> help_as_option(int argc, char** argv);

}  // namespace edgevo::app
