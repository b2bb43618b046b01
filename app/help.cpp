#include "help.h"

#include <cstring>

namespace edgevo::app {
namespace {

bool is_command(const CLI::App& app, const std::string& word) {
  return !app.get_subcommands([&](const CLI::App* command) { return command->get_name() == word; }).empty();
}

}  // namespace

void add_help_command(CLI::App& app) {
  app.add_subcommand(
      "help", "what a sub-command does, and its options; `help parameters`: what --set and --params take");
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

}  // namespace edgevo::app
