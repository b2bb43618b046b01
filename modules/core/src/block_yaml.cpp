// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/block_yaml.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr std::string_view kBlanks = " \t\r";  // \r: Windows line ends

bool is_key_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
}

std::string_view trimmed(std::string_view s) {
  const size_t begin = s.find_first_not_of(kBlanks);
  return begin == std::string_view::npos ? std::string_view()
                                         : s.substr(begin, s.find_last_not_of(kBlanks) - begin + 1);
}

// The text up to a '#' at its start or after a blank.
std::string_view without_comment(std::string_view s) {
  for (size_t i = 0; i < s.size(); ++i)
    if (s[i] == '#' && (i == 0 || kBlanks.find(s[i - 1]) != std::string_view::npos)) return s.substr(0, i);
  return s;
}

// Parses what follows `key:` on its line.
class Value {
 public:
  Value(std::string_view text, std::string where) : rest_(trimmed(text)), where_(std::move(where)) {}

  // Returns false if there is none.
  bool read(std::string* value) {
    if (rest_.empty() || rest_.front() == '#') return false;
    if (rest_.front() == '\'') return read_single_quoted(value);
    if (rest_.front() == '"') return read_double_quoted(value);
    return read_plain(value);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw InputError(where_, what, remedy);
  }
  bool read_plain(std::string* value) {
    const std::string_view plain = trimmed(without_comment(rest_));
    const char first = plain.front();
    if (first == '[' || first == '{' || plain == "-" || plain.substr(0, 2) == "- ")
      fail("contains a list or a { } map, but every parameter is one value",
           "write one `key: value` per line");
    if (std::string_view("|>&*!%@`,]}?").find(first) != std::string_view::npos)
      fail(std::string("a value cannot begin with ") + first, "quote it if it is a text");
    if (plain.find(": ") != std::string_view::npos || plain.back() == ':')
      fail("contains a second colon", "write one `key: value` per line, and quote texts with colons");
    if (plain == "~" || plain == "null") return false;
    *value = std::string(plain);
    return true;
  }
  bool read_single_quoted(std::string* value) {
    for (size_t i = 1; i < rest_.size(); ++i) {
      if (rest_[i] != '\'') {
        *value += rest_[i];
      } else if (i + 1 < rest_.size() && rest_[i + 1] == '\'') {
        *value += '\'';
        ++i;
      } else {
        return expect_end(i + 1);
      }
    }
    fail("a quote is not closed on its line", "close it with '");
  }
  bool read_double_quoted(std::string* value) {
    for (size_t i = 1; i < rest_.size(); ++i) {
      if (rest_[i] == '"') return expect_end(i + 1);
      *value += rest_[i] == '\\' ? unescape(++i) : rest_[i];
    }
    fail("a quote is not closed on its line", "close it with \"");
  }
  char unescape(size_t i) const {
    const char c = i < rest_.size() ? rest_[i] : '\0';
    switch (c) {
      case '\\':
      case '"':
      case '/':
        return c;
      case 'n':
        return '\n';
      case 't':
        return '\t';
      case 'r':
        return '\r';
    }
    fail("an escape in a double-quoted text is not one of \\\\ \\\" \\/ \\n \\t \\r", "use single quotes");
  }
  bool expect_end(size_t from) const {
    const std::string_view after = rest_.substr(from);
    if (!trimmed(without_comment(after)).empty())
      fail("something follows the closing quote", "remove it or put it into the quotes");
    return true;
  }

  std::string_view rest_;
  std::string where_;
};

// Tracks the open groups from line to line.
class Reader {
 public:
  explicit Reader(std::string where) : file_(std::move(where)) {}

  void read_line(std::string_view line) {
    ++number_;
    const size_t indent = line.find_first_not_of(' ');
    if (indent == std::string_view::npos) return;
    std::string_view content = line.substr(indent);
    if (trimmed(without_comment(content)).empty()) return;
    if (indent == 0 && is_document_start(content)) return;
    if (content.front() == '\t') fail("is indented with a tab", "indent with blanks");
    read_entry(indent, content);
  }

  std::vector<YamlEntry> entries;

 private:
  struct Level {
    size_t indent;
    std::string prefix;  // "mapping."; empty at the top level
  };

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw InputError(here(), what, remedy);
  }
  std::string here() const { return file_ + ":" + std::to_string(number_); }

  bool is_document_start(std::string_view content) const {
    if (trimmed(without_comment(content)) != "---") return false;
    if (!entries.empty()) fail("begins a second document", "keep one");
    return true;
  }
  void read_entry(size_t indent, std::string_view content) {
    if (content.front() == '-' && (content.size() == 1 || kBlanks.find(content[1]) != std::string_view::npos))
      fail("contains a list, but every parameter is one value", "write `key: value`");
    const auto end = std::find_if_not(content.begin(), content.end(), is_key_character);
    const size_t length = size_t(end - content.begin());
    const bool is_key =
        length > 0 && length < content.size() && content[length] == ':' &&
        (length + 1 == content.size() || kBlanks.find(content[length + 1]) != std::string_view::npos);
    if (!is_key) fail("is not readable as `key: value`", "write a name, a colon, a blank and one value");
    enter_level(indent);
    YamlEntry entry{levels_.back().prefix + std::string(content.substr(0, length)), "", true, number_};
    entry.has_value = Value(content.substr(length + 1), here()).read(&entry.value);
    add(entry);
  }
  void enter_level(size_t indent) {
    if (levels_.empty()) levels_.push_back({indent, ""});
    if (indent > levels_.back().indent) {
      if (entries.empty() || entries.back().has_value)
        fail("is indented more than the line above, which opens no group",
             "align it with the other keys of its group");
      levels_.push_back({indent, entries.back().key + "."});
    }
    while (levels_.size() > 1 && indent < levels_.back().indent) levels_.pop_back();
    if (indent != levels_.back().indent)
      fail("does not align with any line above", "indent it like the other keys of its group");
  }
  void add(const YamlEntry& entry) {
    const auto [first, is_new] = lines_.emplace(entry.key, number_);
    if (!is_new)
      fail(entry.key + " was given in line " + std::to_string(first->second) + " already", "keep one");
    entries.push_back(entry);
  }

  std::string file_;
  int number_ = 0;
  std::vector<Level> levels_;
  std::map<std::string, int> lines_;
};

bool is_plain_text(const std::string& text) {
  const auto safe = [](char c) { return is_key_character(c) || c == '/' || c == '+'; };
  const auto is_word_of_yaml = [&] {
    for (const char* word : {"null", "true", "false", "yes", "no", "on", "off", ".nan", ".inf"})
      if (std::equal(text.begin(), text.end(), word, word + std::char_traits<char>::length(word),
                     [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; }))
        return true;
    return false;
  };
  const auto begins_well = [&] {
    const char c = text.front();
    return std::isalpha(static_cast<unsigned char>(c)) || c == '/' || c == '_' || c == '.';
  };
  return !text.empty() && begins_well() && std::all_of(text.begin(), text.end(), safe) && !is_word_of_yaml();
}

std::string quoted(const std::string& text) {
  const bool has_control =
      std::any_of(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t' || c == '\r'; });
  if (!has_control) {
    std::string out = "'";
    for (char c : text) out += c == '\'' ? "''" : std::string(1, c);
    return out + "'";
  }
  std::string out = "\"";
  for (char c : text) {
    switch (c) {
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\r':
        out += "\\r";
        break;
      case '"':
      case '\\':
        out += '\\';
        [[fallthrough]];
      default:
        out += c;
    }
  }
  return out + "\"";
}

}  // namespace

std::vector<YamlEntry> parse_block_yaml(std::string_view text, const std::string& where) {
  Reader reader(where);
  while (!text.empty()) {
    const size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    reader.read_line(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return std::move(reader.entries);
}

std::string yaml_scalar(const std::string& text) { return is_plain_text(text) ? text : quoted(text); }

}  // namespace edgevo
