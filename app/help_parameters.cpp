// SPDX-License-Identifier: BSD-3-Clause
#include "help_parameters.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/results/run_params.h"
#include "help.h"

namespace edgevo::app {
namespace {

constexpr size_t kLineWidth = 100;  // characters
constexpr const char* kIndent = "      ";

// `text` in lines of at most kLineWidth characters, each indented.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string result, line = kIndent, word;
  while (words >> word) {
    if (line.size() + 1 + word.size() > kLineWidth) result += line + "\n", line = kIndent;
    if (line != kIndent) line += ' ';
    line += word;
  }
  return result + line + "\n";
}

std::string entry(const ParamDescription& p) {
  const std::string range = p.range.empty() ? "" : "    " + p.range;
  return "  " + p.key + ": " + p.value + range + "\n" + wrapped(p.help);
}

std::string section(const std::vector<ParamDescription>& params, ParamLevel level, const char* meaning) {
  std::string entries;
  for (const ParamDescription& p : params)
    if (p.level == level) entries += entry(p);
  return entries.empty() ? "" : "\n" + std::string(to_string(level)) + ": " + meaning + "\n" + entries;
}

std::vector<ParamDescription> parameters_of_run() {
  RunParams defaults;
  return describe_params([&](ParamVisitor& v) { defaults.visit(v); });
}

}  // namespace

std::string parameters_text(const std::vector<ParamDescription>& params, bool all) {
  std::string text =
      "Parameters of `edgevo run`, set with --set KEY=VALUE or in a YAML file for --params.\n"
      "KEY: DEFAULT    [RANGE] or CHOICES\n";
  text += section(params, kBasic, "for all users");
  if (!all) {
    const auto others = std::count_if(params.begin(), params.end(),
                                      [](const ParamDescription& p) { return p.level != kBasic; });
    return text + "\n" + std::to_string(others) + " more: edgevo help parameters --all\n";
  }
  text += section(params, kAdvanced, "measure what you change");
  return text + section(params, kExperimental, "parts of the method that can be switched off");
}

bool print_parameters_help(int argc, const char* const* argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.size() < 2 || words[0] != "help" || words[1] != "parameters") return false;
  for (size_t i = 2; i < words.size(); ++i)
    if (words[i] != "--all")
      throw InputError("edgevo help parameters", "unknown argument '" + words[i] + "'",
                       "give --all or nothing");
  std::fputs(parameters_text(parameters_of_run(), words.size() > 2).c_str(), stdout);
  return true;
}

void write_parameters_help(const std::string& folder) {
  const std::vector<ParamDescription> params = parameters_of_run();
  write_file(folder + "/" + help_file_name("parameters"), parameters_text(params, false));
  write_file(folder + "/" + help_file_name("parameters-all"), parameters_text(params, true));
}

}  // namespace edgevo::app
