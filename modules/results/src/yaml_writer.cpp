// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/yaml_writer.h"

#include <sstream>

#include "edgevo/core/output_file.h"

namespace edgevo {

std::string yaml_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (quoted += '\\') += c;
    else if (c == '\n')
      quoted += "\\n";
    else if (c == '\t')
      quoted += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20)
      quoted += ' ';
    else
      quoted += c;
  }
  return quoted + '"';
}

void YamlWriter::number(const std::string& key, double value, int decimals) {
  line(key, fixed(value, decimals));
}

void YamlWriter::list(const std::string& key, const std::vector<std::string>& values) {
  std::string joined;
  for (const std::string& v : values) joined += (joined.empty() ? "" : ", ") + yaml_quoted(v);
  line(key, "[" + joined + "]");
}

void YamlWriter::block(const std::string& key, const std::string& yaml) {
  if (yaml.empty()) return line(key, "{}");
  open(key);
  std::istringstream lines(yaml);
  for (std::string one; std::getline(lines, one);) text_ += indent() + one + '\n';
  close();
}

void YamlWriter::line(const std::string& key, const std::string& value) {
  text_ += indent() + key + (value.empty() ? ":" : ": " + value) + '\n';
}

}  // namespace edgevo
