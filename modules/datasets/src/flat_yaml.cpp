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

bool is_in(const std::string& text, char open, char close) {
  return text.size() >= 2 && text.front() == open && text.back() == close;
}

std::string inside(const std::string& text) { return text.substr(1, text.size() - 2); }

// The number of brackets open after `text`, of which `open` were before. Throws InputError where they do not
// match or nest too deep.
int open_brackets(const std::string& text, int open, const std::string& where) {
  constexpr int kDeepest = 8;  // calibrations need two
  for (const char c : text) {
    open += (c == '[' || c == '{') - (c == ']' || c == '}');
    if (open < 0 || open > kDeepest) throw InputError(where, "brackets do not match", "check the YAML");
  }
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

struct Line {
  std::string text;  // without a comment
  int number;
};

bool is_list_item(const std::string& content) { return content == "-" || content.rfind("- ", 0) == 0; }

class FlatYaml {
 public:
  explicit FlatYaml(std::string where) : where_(std::move(where)) {}

  void line(const Line& line) {
    number_ = line.number;
    const size_t indent = line.text.find_first_not_of(" \t");
    const std::string content = trimmed(line.text);
    if (is_list_item(content)) {
      list_item(indent, trimmed(content.substr(1)));
      return;
    }
    while (!groups_.empty() && groups_.back().indent >= indent) groups_.pop_back();
    const std::string prefix = groups_.empty() ? "" : groups_.back().key + ".";
    const std::string key = entry(content, prefix);
    const size_t colon = content.find(':');
    if (colon + 1 != content.size() && content.find("!!", colon) == std::string::npos) return;
    if (values_.emplace(key, YamlValue{{}, number_, false}).second) opened_.push_back(key);
    groups_.push_back({indent, key});
  }
  YamlValues take() {
    for (const std::string& key : opened_) drop_if_group(key);
    return std::move(values_);
  }

 private:
  struct Group {
    size_t indent;
    std::string key;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(where_ + ", line " + std::to_string(number_), what, "check the YAML");
  }
  // One `key: value`, whose brackets are closed; `key:` alone opens a group. Returns the dotted key.
  std::string entry(const std::string& line, const std::string& prefix) {
    const size_t colon = line.find(':');
    if (colon == std::string::npos) fail("a line is not `key: value`");
    std::string key = prefix + lower(unquoted(line.substr(0, colon)));
    value(key, without_tag(trimmed(line.substr(colon + 1))));
    return key;
  }
  static std::string without_tag(const std::string& text) {
    if (text.empty() || text.front() != '!') return text;
    const size_t end = text.find_first_of(" \t\n");
    return end == std::string::npos ? std::string() : trimmed(text.substr(end));
  }
  void value(const std::string& key, const std::string& text) {
    if (text.empty()) return;
    if (is_in(text, '{', '}')) {
      for (const std::string& item : split_items(inside(text))) entry(item, key + ".");
    } else if (is_in(text, '[', ']')) {
      append_list(inside(text), &set(key));
    } else {
      set(key).push_back(unquoted(text));
    }
  }
  static void append_list(const std::string& text, std::vector<std::string>* list) {
    for (const std::string& item : split_items(text)) {
      const std::string t = trimmed(item);
      if (is_in(t, '[', ']'))
        append_list(inside(t), list);
      else
        list->push_back(unquoted(t));
    }
  }
  // "- x" below its key, at the same indentation or deeper.
  void list_item(size_t indent, const std::string& item) {
    while (!groups_.empty() && groups_.back().indent > indent) groups_.pop_back();
    if (groups_.empty()) fail("a list item belongs to no key");
    YamlValue& list = values_[groups_.back().key];
    list.is_given = true;
    if (is_in(item, '[', ']'))
      append_list(inside(item), &list.texts);
    else if (is_list_item(item))
      list.texts.push_back(unquoted(item.substr(1)));  // "- - x", a row of a matrix
    else if (!item.empty())
      list.texts.push_back(unquoted(item));
  }
  std::vector<std::string>& set(const std::string& key) {
    const auto [it, is_new] = values_.emplace(key, YamlValue{{}, number_, true});
    if (!is_new) throw InputError(where_, "the key " + quote(key) + " is given twice", "keep one");
    return it->second.texts;
  }
  // `key:` that has keys below it is not a value.
  void drop_if_group(const std::string& key) {
    const auto below = values_.lower_bound(key + ".");
    const bool has_keys = below != values_.end() && below->first.rfind(key + ".", 0) == 0;
    const auto it = values_.find(key);
    if (has_keys && it != values_.end() && !it->second.is_given) values_.erase(it);
  }

  std::string where_;
  int number_ = 0;
  YamlValues values_;
  std::vector<Group> groups_;
  std::vector<std::string> opened_;
};

std::string without_comment(const std::string& line) {
  for (size_t i = 0; i < line.size(); ++i)
    if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) return line.substr(0, i);
  return line;
}

bool ends_document(const std::string& content) { return content == "---" || content == "..."; }

// The lines of each document; those inside open brackets are joined to the line that opened them.
std::vector<std::vector<Line>> logical_lines(const std::string& text, const std::string& where) {
  std::vector<std::vector<Line>> documents(1);
  int open = 0, number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = without_comment(text.substr(begin, end - begin)), content = trimmed(line);
    begin = end + 1;
    ++number;
    if (open == 0 && (content.empty() || content[0] == '%')) continue;
    if (open == 0 && ends_document(content)) {
      if (!documents.back().empty()) documents.emplace_back();
      continue;
    }
    if (open > 0)
      documents.back().back().text += " " + content;
    else
      documents.back().push_back({line, number});
    open = open_brackets(line, open, where);
  }
  if (open != 0) throw InputError(where, "a bracket is not closed", "check the YAML");
  if (documents.back().empty()) documents.pop_back();
  return documents;
}

}  // namespace

std::vector<YamlValues> parse_yaml_documents(const std::string& text, const std::string& where) {
  std::vector<YamlValues> documents;
  for (const auto& lines : logical_lines(text, where)) {
    FlatYaml yaml(where);
    for (const Line& line : lines) yaml.line(line);
    documents.push_back(yaml.take());
  }
  return documents;
}

YamlValues parse_flat_yaml(const std::string& text, const std::string& where) {
  std::vector<YamlValues> documents = parse_yaml_documents(text, where);
  if (documents.size() > 1) throw InputError(where, "holds several documents", "keep one");
  return documents.empty() ? YamlValues() : std::move(documents.front());
}

std::vector<double> yaml_numbers(const YamlValues& values, const std::vector<std::string>& keys,
                                 const std::string& where) {
  for (const std::string& key : keys) {
    const auto it = values.find(key);
    if (it == values.end()) continue;
    std::vector<double> numbers;
    for (const std::string& text : it->second.texts)
      numbers.push_back(parse_number(text, where + ", " + key));
    return numbers;
  }
  return {};
}

}  // namespace edgevo
