// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/parameters_text.h"

#include <algorithm>
#include <sstream>

namespace edgevo {
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

std::string parameter_entry(const ParamDescription& p) {
  const std::string range = p.range.empty() ? "" : "    " + p.range;
  return "  " + p.key + ": " + p.value + range + "\n" + wrapped(p.help);
}

std::string parameter_section(const std::vector<ParamDescription>& params, ParamLevel level,
                              const char* meaning) {
  std::string entries;
  for (const ParamDescription& p : params)
    if (p.level == level) entries += parameter_entry(p);
  return entries.empty() ? "" : "\n" + std::string(to_string(level)) + ": " + meaning + "\n" + entries;
}

}  // namespace

std::string parameters_text(const std::vector<ParamDescription>& params, bool all) {
  std::string text =
      "Parameters of `edgevo run`, set with --set KEY=VALUE or in a YAML file for --params.\n"
      "KEY: DEFAULT    [RANGE] or CHOICES\n";
  text += parameter_section(params, kBasic, "for all users");
  if (!all) {
    const auto others = std::count_if(params.begin(), params.end(),
                                      [](const ParamDescription& p) { return p.level != kBasic; });
    return text + "\n" + std::to_string(others) + " more: edgevo help parameters --all\n";
  }
  text += parameter_section(params, kAdvanced, "measure what you change");
  return text +
         parameter_section(params, kExperimental,
                           "parts of the method that can be switched off, and thresholds of its tests");
}

}  // namespace edgevo
