// SPDX-License-Identifier: BSD-3-Clause
#include "yaml_text.h"

#include <charconv>
#include <sstream>

namespace edgevo {

std::string yaml_real(double value) {
  char buffer[32];
  std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string yaml_list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + yaml_real(value);
  return "[" + text + "]";
}

std::string yaml_comment(const std::string& comment) {
  std::istringstream lines(comment);
  std::string text;
  for (std::string line; std::getline(lines, line);) text += "# " + line + '\n';
  return text;
}

}  // namespace edgevo
