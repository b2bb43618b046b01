// SPDX-License-Identifier: BSD-3-Clause
#include "help.h"

#include <cstring>
#include <sstream>

#include "edgevo/core/output_file.h"

namespace edgevo::app {
namespace {

bool is_command(const CLI::App& app, const std::string& word) {
  return !app.get_subcommands([&](const CLI::App* command) { return command->get_name() == word; }).empty();
}

// The output of `edgevo COMMAND --help`; empty if the command has no help of its own.
std::string printed_help(CLI::App& app, const std::string& command) {
  std::vector<std::string> last_word_first{"--help"};
  if (!command.empty()) last_word_first.push_back(command);
  std::ostringstream text;
  try {
    app.parse(last_word_first);
  } catch (const CLI::CallForHelp& e) {
    app.exit(e, text, text);
  }
  return text.str();
}

void write_help_of(CLI::App& app, const std::string& command, const std::string& folder) {
  const std::string text = printed_help(app, command);
  if (!text.empty()) write_file(folder + "/" + help_file_name(command), text);
}

}  // namespace

void add_help_command(CLI::App& app) {
  app.add_subcommand(
      "help", "show the help of a sub-command; `help parameters`: list the parameters of --set and --params");
}

std::vector<char*> help_as_option(const CLI::App& app, int argc, char** argv) {
  static char help_option[] = "--help";
  std::vector<char*> words(argv, argv + argc);
  if (argc < 2 || std::strcmp(argv[1], "help") != 0) return words;
  words.resize(1);
  if (argc > 2) words.push_back(argv[2]);
  if (argc == 2 || is_command(app, argv[2])) words.push_back(help_option);
  return words;
}

std::string help_file_name(const std::string& command) {
  return "edgevo" + (command.empty() ? "" : "-" + command) + ".txt";
}

void write_help(CLI::App& app, const std::string& folder) {
  make_output_folder(folder);
  write_help_of(app, "", folder);
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    write_help_of(app, command->get_name(), folder);
}

}  // namespace edgevo::app
