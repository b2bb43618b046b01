// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>

#include "camera_yaml.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

std::string unquoted(const std::string& text) {
  const std::string t = trimmed(text);
  const bool quoted = t.size() >= 2 && (t.front() == '"' || t.front() == '\'') && t.back() == t.front();
  return quoted ? t.substr(1, t.size() - 2) : t;
}

int open_brackets(const std::string& text) {
  int open = 0;
  for (const char c : text) open += (c == '[' || c == '{') - (c == ']' || c == '}');
  return open;
}

// Splits at commas outside of brackets.
std::vector<std::string> split_items(const std::string& text) {
  std::vector<std::string> items(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    if (c == ',' && depth == 0)
      items.emplace_back();
    else
      items.back() += c;
  }
  if (trimmed(items.back()).empty()) items.pop_back();
  return items;
}

class FlatYaml {
 public:
  explicit FlatYaml(std::string where) : where_(std::move(where)) {}

  // One `key: value`, whose brackets are closed; `key:` alone opens a group.
  void entry(const std::string& line, const std::string& prefix) {
    const size_t colon = line.find(':');
    if (colon == std::string::npos) throw InputError(where_, "a line is not `key: value`", "check the YAML");
    const std::string key = prefix + lower(unquoted(line.substr(0, colon)));
    value(key, without_tag(trimmed(line.substr(colon + 1))));
  }
  YamlValues take() { return std::move(values_); }

 private:
  static std::string without_tag(const std::string& text) {
    if (text.empty() || text.front() != '!') return text;
    const size_t end = text.find_first_of(" \t\n");
    return end == std::string::npos ? std::string() : trimmed(text.substr(end));
  }
  void value(const std::string& key, const std::string& text) {
    if (text.empty()) return;
    if (text.front() == '{' && text.back() == '}') {
      for (const std::string& item : split_items(text.substr(1, text.size() - 2))) entry(item, key + ".");
    } else if (text.front() == '[' && text.back() == ']') {
      auto& list = set(key);
      for (const std::string& item : split_items(text.substr(1, text.size() - 2)))
        list.push_back(unquoted(item));
    } else {
      set(key) = {unquoted(text)};
    }
  }
  std::vector<std::string>& set(const std::string& key) {
    const auto [it, is_new] = values_.emplace(key, std::vector<std::string>());
    if (!is_new) throw InputError(where_, "the key " + quote(key) + " is given twice", "keep one");
    return it->second;
  }

  std::string where_;
  YamlValues values_;
};

struct Group {
  size_t indent;
  std::string prefix;
};

std::string without_comment(const std::string& line) {
  for (size_t i = 0; i < line.size(); ++i)
    if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) return line.substr(0, i);
  return line;
}

bool is_skipped(const std::string& content) {
  return content.empty() || content[0] == '%' || content == "---" || content == "..." || content == "-" ||
         content.rfind("- ", 0) == 0;
}

// Lines without comments; those inside open brackets are joined to the line that opened them.
std::vector<std::string> logical_lines(const std::string& text, const std::string& where) {
  constexpr int kDeepest = 8;  // nesting of brackets; calibrations need two
  std::vector<std::string> lines;
  int open = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = without_comment(text.substr(begin, end - begin));
    begin = end + 1;
    if (open == 0 && is_skipped(trimmed(line))) continue;
    if (open > 0)
      lines.back() += " " + trimmed(line);
    else
      lines.push_back(line);
    open += open_brackets(line);
    if (open < 0 || open > kDeepest) throw InputError(where, "brackets do not match", "check the YAML");
  }
  if (open != 0) throw InputError(where, "a bracket is not closed", "check the YAML");
  return lines;
}

}  // namespace

YamlValues parse_flat_yaml(const std::string& text, const std::string& where) {
  FlatYaml yaml(where);
  std::vector<Group> groups;
  for (const std::string& line : logical_lines(text, where)) {
    const size_t indent = line.find_first_not_of(" \t");
    while (!groups.empty() && groups.back().indent >= indent) groups.pop_back();
    const std::string prefix = groups.empty() ? "" : groups.back().prefix;
    yaml.entry(line, prefix);
    const std::string content = trimmed(line);
    const size_t colon = content.find(':');
    if (colon + 1 == content.size() || content.find("!!", colon) != std::string::npos)
      groups.push_back({indent, prefix + lower(unquoted(content.substr(0, colon))) + "."});
  }
  return yaml.take();
}

std::vector<double> yaml_numbers(const YamlValues& values, const std::vector<std::string>& keys,
                                 const std::string& where) {
  for (const std::string& key : keys) {
    const auto it = values.find(key);
    if (it == values.end()) continue;
    std::vector<double> numbers;
    for (const std::string& text : it->second) numbers.push_back(parse_number(text, where + ", " + key));
    return numbers;
  }
  return {};
}

}  // namespace edgevo
