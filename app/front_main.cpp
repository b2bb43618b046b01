// `edgevo`, the program that users call. What needs neither images nor maps it does itself, in a hundredth of
// a second: --version, the help texts, eval on two files. For all else it becomes edgevo-commands
// (main.cpp), which loads hundreds of shared libraries before it begins.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "become.h"
#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/files/program_folder.h"
#include "edgevo/evaluation/trajectory.h"
#include "help.h"
#include "version.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

constexpr int kDone = 0, kBadInput = 2;

using Words = std::vector<std::string>;  // of the command line, the program's name first

// Next to this program in a build; in an installation a folder that nobody's PATH names.
fs::path commands_program() {
  const fs::path here = program_folder(), name = "edgevo-commands";
  std::error_code ignored;
  return fs::exists(here / name, ignored) ? here / name
                                          : (here / EDGEVO_LIBEXEC_FROM_BIN / name).lexically_normal();
}

[[noreturn]] void become_commands(const Words& words) {
  become(commands_program(), words, "install or build edgevo anew");
}

// The sub-command whose help is asked for, "" for that of the program; none where something else is.
std::optional<std::string> asked_help(const Words& words) {
  const auto is_help = [](const std::string& word) { return word == "--help" || word == "-h"; };
  if (words.size() == 2 && (words[1] == "help" || is_help(words[1]))) return "";
  if (words.size() != 3) return std::nullopt;
  if (words[1] == "help") return words[2];
  return is_help(words[2]) ? std::optional(words[1]) : std::nullopt;
}

// What edgevo-commands wrote when it was built. Without a text (a word that is no sub-command, for example)
// that program has the say.
bool print_help(const std::string& command) {
  if (command.find_first_not_of("abcdefghijklmnopqrstuvwxyz") != std::string::npos) return false;
  std::ifstream file(data_folder() / "help" / help_file_name(command));
  std::stringstream text;
  if (!(text << file.rdbuf())) return false;
  std::fputs(text.str().c_str(), stdout);
  return true;
}

// The error messages of a wrong command line are those of edgevo-commands, which knows all sub-commands.
int eval(const Words& words) {
  CLI::App app;
  Action action;
  add_eval_command(app, &action, [&](const std::string&) -> Trajectory { become_commands(words); });
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
  } catch (const CLI::ParseError&) {
    become_commands(words);
  }
  return action();
}

int run(const Words& words) {
  if (words.size() == 2 && words[1] == "--version") {
    std::puts(version_text().c_str());
    return kDone;
  }
  const std::optional<std::string> command = asked_help(words);
  if (command && print_help(*command)) return kDone;
  if (words.size() > 1 && words[1] == "eval") return eval(words);
  become_commands(words);
}

}  // namespace
}  // namespace edgevo::app

int main(int argc, char** argv) {
  using namespace edgevo::app;
  try {
    return run(Words(argv, argv + argc));
  } catch (const std::bad_alloc&) {
    std::fputs("edgevo: out of memory; end other programs and run again\n", stderr);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "edgevo: %s\n", e.what());
  }
  return kBadInput;
}
