// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writer for the YAML of summaries: keys, quoted strings, numbers with fixed decimals.
#include <string>
#include <vector>

namespace edgevo {

/// `text` as a YAML string in double quotes, with special characters escaped.
std::string yaml_quoted(const std::string& text);

/// Writes `key: value` lines, indented by two spaces a level.
class YamlWriter {
 public:
  /// Begins a group: entries up to close() are nested below `key`.
  void open(const std::string& key) { line(key, ""), ++depth_; }
  /// Ends the innermost open().
  void close() { --depth_; }
  /// Writes a string in double quotes.
  void text(const std::string& key, const std::string& value) { line(key, yaml_quoted(value)); }
  /// Writes an integer.
  void integer(const std::string& key, long value) { line(key, std::to_string(value)); }
  /// Writes a number with `decimals` digits after the point.
  void number(const std::string& key, double value, int decimals);
  /// Writes true or false.
  void boolean(const std::string& key, bool value) { line(key, value ? "true" : "false"); }
  /// Writes a list of strings in one line, each in double quotes.
  void list(const std::string& key, const std::vector<std::string>& values);
  /// Writes lines that are YAML already, nested below `key`.
  void block(const std::string& key, const std::string& yaml);
  /// The text written so far.
  const std::string& str() const { return text_; }

 private:
  std::string indent() const { return std::string(size_t(2 * depth_), ' '); }
  void line(const std::string& key, const std::string& value);

  std::string text_;
  int depth_ = 0;
};

}  // namespace edgevo
