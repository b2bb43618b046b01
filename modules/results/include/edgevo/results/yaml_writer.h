#pragma once
// The YAML that summaries are written in: keys, quoted texts, numbers of so many decimals.
#include <string>
#include <vector>

namespace edgevo {

/// A YAML string in double quotes, whatever it holds.
std::string yaml_quoted(const std::string& text);

/// Writes `key: value` lines with two spaces of indent a level.
class YamlWriter {
 public:
  /// What follows, up to close(), stands below `key`.
  void open(const std::string& key) { line(key, ""), ++depth_; }
  void close() { --depth_; }  ///< ends the innermost open()
  /// in double quotes
  void text(const std::string& key, const std::string& value) { line(key, yaml_quoted(value)); }
  void integer(const std::string& key, long value) { line(key, std::to_string(value)); }  ///< a whole number
  void number(const std::string& key, double value, int decimals);  ///< with so many decimals
  /// true or false
  void boolean(const std::string& key, bool value) { line(key, value ? "true" : "false"); }
  void list(const std::string& key, const std::vector<std::string>& values);  ///< [in, double, quotes]
  /// Lines that are YAML already, below `key`.
  void block(const std::string& key, const std::string& yaml);
  const std::string& str() const { return text_; }  ///< all that was written

 private:
  std::string indent() const { return std::string(size_t(2 * depth_), ' '); }
  void line(const std::string& key, const std::string& value);

  std::string text_;
  int depth_ = 0;
};

}  // namespace edgevo
