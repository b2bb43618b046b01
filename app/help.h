#pragma once
// `edgevo help COMMAND` says what `edgevo COMMAND --help` says; and these texts as files, which the build
// writes, so that showing one needs no library that the command itself does.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace edgevo::app {

/// Lists `help` among the sub-commands.
void add_help_command(CLI::App& app);

/// The words of the command line, `help COMMAND ...` as `COMMAND --help` and a lone `help` as `--help`; what
/// is no sub-command of `app` stands alone, and is refused as such. They point into `argv`.
std::vector<char*> help_as_option(const CLI::App& app, int argc, char** argv);

/// "edgevo-COMMAND.txt", the file of a sub-command's help; "edgevo.txt" for an empty `command`.
std::string help_file_name(const std::string& command);

/// Writes what --help prints for `app` and for each of its sub-commands into `folder`, which is made. A
/// sub-command without a help of its own is left out.
void write_help(CLI::App& app, const std::string& folder);

}  // namespace edgevo::app
