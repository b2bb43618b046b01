// SPDX-License-Identifier: BSD-3-Clause
// `edgevo`, the program that users call. It handles what needs neither images nor maps itself, within a
// hundredth of a second: --version, the help texts, and eval on two files. For everything else it replaces
// itself with edgevo-commands (main.cpp), which loads hundreds of shared libraries at its start.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "become.h"
#include "commands.h"
#include "edgevo/evaluation/trajectory.h"
#include "edgevo/files/program_folder.h"
#include "help.h"
#include "standard_output.h"
#include "version.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

constexpr int kDone = 0, kBadInput = 2;

using Words = std::vector<std::string>;  // the command line, starting with the program's name

// Next to this program in a build; in an installation, in a folder outside PATH.
fs::path commands_program() {
  const fs::path here = program_folder(), name = "edgevo-commands";
  std::error_code ignored;
  return fs::exists(here / name, ignored) ? here / name
                                          : (here / EDGEVO_LIBEXEC_FROM_BIN / name).lexically_normal();
}

[[noreturn]] void become_commands(const Words& words) {
  become(commands_program(), words, "reinstall or rebuild edgevo");
}

// The sub-command whose help is requested, "" for the program itself; none if the request is not for help.
std::optional<std::string> requested_help(const Words& words) {
  const auto is_help = [](const std::string& word) { return word == "--help" || word == "-h"; };
  if (words.size() == 2 && (words[1] == "help" || is_help(words[1]))) return "";
  if (words.size() == 4 && words[1] == "help" && words[2] == "parameters" && words[3] == "--all")
    return "parameters-all";
  if (words.size() != 3) return std::nullopt;
  if (words[1] == "help") return words[2];
  return is_help(words[2]) && words[1] != "parameters" ? std::optional(words[1]) : std::nullopt;
}

// Prints the text that edgevo-commands wrote during the build. Returns false if there is none, for example
// for an unknown sub-command; edgevo-commands then reports the error.
bool print_help(const std::string& command) {
  if (command.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos) return false;
  std::ifstream file(data_folder() / "help" / help_file_name(command));
  std::stringstream text;
  if (!(text << file.rdbuf())) return false;
  std::fputs(text.str().c_str(), stdout);
  return true;
}

// Errors on the command line are left to edgevo-commands, which knows all sub-commands.
int eval(const Words& words) {
  CLI::App app;
  Action action;
  add_eval_command(
      app, &action, [&](const std::string&) -> Trajectory { become_commands(words); },
      [&](const RunEvaluationRequest&) -> int { become_commands(words); },
      [&](const MapEvaluationRequest&) -> int { become_commands(words); });
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
  const std::optional<std::string> command = requested_help(words);
  if (command && print_help(*command)) return kDone;
  if (words.size() > 1 && words[1] == "eval") return eval(words);
  become_commands(words);
}

}  // namespace
}  // namespace edgevo::app

int main(int argc, char** argv) {
  edgevo::app::print_line_by_line();
  using namespace edgevo::app;
  try {
    return end_of_output(run(Words(argv, argv + argc)));
  } catch (const std::bad_alloc&) {
    std::fputs("edgevo: out of memory; close other programs and try again\n", stderr);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "edgevo: %s\n", e.what());
  }
  return kBadInput;
}
