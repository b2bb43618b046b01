// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// `edgevo help COMMAND`, equivalent to `edgevo COMMAND --help`, and the help texts as files, which the build
// writes so that printing one loads none of the libraries of the command.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace edgevo::app {

/// Adds `help` to the sub-commands.
void add_help_command(CLI::App& app);

/// The words of the command line with `help COMMAND ...` replaced by `COMMAND --help` and a lone `help` by
/// `--help`; an unknown COMMAND stays alone, so that parsing reports it. The pointers are those of `argv`.
std::vector<char*> help_as_option(const CLI::App& app, int argc, char** argv);

/// File name of the help of a sub-command: "edgevo-COMMAND.txt", or "edgevo.txt" for an empty `command`.
std::string help_file_name(const std::string& command);

/// Writes the output of --help of `app` and of each sub-command into `folder`, which is created. Sub-commands
/// without a help of their own are skipped.
void write_help(CLI::App& app, const std::string& folder);

}  // namespace edgevo::app
