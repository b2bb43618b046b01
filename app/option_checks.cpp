// SPDX-License-Identifier: BSD-3-Clause
#include "option_checks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "edgevo/core/error.h"

namespace edgevo::app {
namespace {

template <typename Number>
bool parse(const std::string& text, Number* value) {
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, *value);
  return read.ec == std::errc() && read.ptr == end;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(word, names);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// A file where a sub-command belongs is to be run, or looked at.
std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored))
    return "'" + word + "' is no sub-command; edgevo run " + word + " -o OUT runs it, edgevo info " + word +
           " shows what is in it";
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return "unknown sub-command '" + word + "'" + did_you_mean(word, names);
}

bool has_option(const CLI::App& command, const std::string& name) {
  const std::vector<std::string> names = option_names(command);
  return std::find(names.begin(), names.end(), name) != names.end();
}

// An option before the sub-command, where only those of the program itself stand.
std::string unknown_program_option(const CLI::App& app, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  std::string commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (name != "--help" && has_option(*command, name))
      commands += (commands.empty() ? "" : ", ") + command->get_name();
  if (commands.empty())
    return "unknown option " + name + did_you_mean(name, option_names(app)) + "; see edgevo --help";
  return "option " + name + " stands before the sub-command; write it after its own: " + commands;
}

std::string unexpected(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('=')), where = command.get_name();
  if (word.rfind("--", 0) != 0)
    return where + ": unexpected argument '" + word + "'; see edgevo " + where + " --help";
  return where + ": unknown option " + name + did_you_mean(name, option_names(command));
}

}  // namespace

CLI::Validator whole_number(uint64_t least, uint64_t most) {
  const auto check = [=](std::string& text) -> std::string {
    uint64_t value = 0;
    if (parse(text, &value) && value >= least && value <= most) return "";
    return "'" + text + "' is not a whole number from " + std::to_string(least) + " to " +
           std::to_string(most);
  };
  return {check, "", "whole number"};
}

CLI::Validator positive_number() {
  const auto check = [](std::string& text) -> std::string {
    double value = 0;
    if (parse(text, &value) && value > 0 && std::isfinite(value)) return "";
    return "'" + text + "' is not a number larger than 0";
  };
  return {check, "", "positive number"};
}

CLI::Validator number_from_zero() {
  const auto check = [](std::string& text) -> std::string {
    double value = 0;
    if (parse(text, &value) && value >= 0 && std::isfinite(value)) return "";
    return "'" + text + "' is not a number, 0 or larger";
  };
  return {check, "", "number"};
}

CLI::Validator number_between(double least, double most) {
  const auto check = [=](std::string& text) -> std::string {
    double value = 0;
    if (parse(text, &value) && value >= least && value <= most) return "";
    std::ostringstream message;
    message << "'" << text << "' is not a number from " << least << " to " << most;
    return message.str();
  };
  return {check, "", "number"};
}

CLI::Validator path_given() {
  const auto check = [](std::string& text) -> std::string {
    return text.empty() ? "'' names no folder" : "";
  };
  return {check, "", "path"};
}

void read_params_given(const std::string& path, const VisitParams& visit, bool quiet) {
  if (read_params_file(path, visit) && !quiet)
    std::fprintf(stderr, "edgevo: %s: its block `parameters` is used\n", path.c_str());
}

void add_force(CLI::App& command, bool* force) {
  command.add_flag("--force", *force, "overwrite existing files, whatever they are");
}

void add_include_doubtful(CLI::App& command, bool* include) {
  command.add_flag("--include-doubtful", *include, "map the points of keyframes made in doubt, too");
}

std::string explain(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const bool is_extra = error.get_exit_code() == int(CLI::ExitCodes::ExtrasError);
  const bool is_alone = app.get_subcommands().empty();
  if (argc > 1 && (is_extra || is_alone) && argv[1][0] == '-') return unknown_program_option(app, argv[1]);
  const std::vector<CLI::App*> commands = app.get_subcommands();
  if (commands.empty()) {
    if (argc > 1 && argv[1][0] != '-') return unknown_command(app, argv[1]);
    return argc == 1 ? "no sub-command given; see edgevo --help"
                     : std::string(error.what()) + "; see edgevo --help";
  }
  const CLI::App& command = *commands.front();
  const std::vector<std::string> rest = command.remaining();
  if (is_extra && !rest.empty()) return unexpected(command, rest.front());
  const std::string name = command.get_name();
  const bool lacks_out = std::string(error.what()).rfind("--out is required", 0) == 0;
  return name + ": " + error.what() + (lacks_out ? "; add -o and a name for the results, or see" : "; see") +
         " edgevo " + name + " --help";
}

}  // namespace edgevo::app
