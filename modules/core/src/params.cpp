// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/params.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "edgevo/core/block_yaml.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"

namespace edgevo {
namespace {

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

// Ten digits if they are exact, else as many as needed to read the same value back.
std::string format_number(double value) {
  char buffer[64];
  const auto text = [&](std::to_chars_result end) { return std::string(buffer, end.ptr); };
  const std::string rounded =
      text(std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 10));
  double back = 0;
  std::from_chars(rounded.data(), rounded.data() + rounded.size(), back);
  return back == value ? rounded : text(std::to_chars(buffer, buffer + sizeof buffer, value));
}

// Collects the dotted names of all keys, for "did you mean" and to detect unknown ones.
class KeyCollector : public ParamVisitor {
 public:
  void on_number(ParamLevel, const char* key, double&, double, double, const char*) override { add(key); }
  void on_integer(ParamLevel, const char* key, int&, int, int, const char*) override { add(key); }
  void on_boolean(ParamLevel, const char* key, bool&, const char*) override { add(key); }
  void on_text(ParamLevel, const char* key, std::string&, const std::vector<std::string>&,
               const char*) override {
    add(key);
  }
  void begin_group(const char* key) override {
    prefix_.push_back(prefix() + key);
    groups.insert(prefix_.back());
  }
  void end_group() override { prefix_.pop_back(); }

  bool knows(const std::string& key) const { return names_.count(key) > 0; }

  std::vector<std::string> keys;  // in the order of visit()
  std::set<std::string> groups;

 private:
  std::string prefix() const { return prefix_.empty() ? "" : prefix_.back() + "."; }
  void add(const char* key) {
    keys.push_back(prefix() + key);
    names_.insert(keys.back());
  }
  std::vector<std::string> prefix_;
  std::set<std::string> names_;  // a benchmark list may have fifty thousand
};

// A given value as text and its location (for messages).
struct Given {
  std::string text, where;
};
using GivenValues = std::map<std::string, Given>;

// Writes given texts into the fields of the same dotted name.
class Assigner : public ParamVisitor {
 public:
  explicit Assigner(const GivenValues& values) : values_(&values) {}

  void on_number(ParamLevel, const char* key, double& value, double min, double max, const char*) override {
    const Given* given = find(key);
    if (!given) return;
    const double parsed = to_number(*given, key);
    if (!(parsed >= min && parsed <= max)) out_of_range(*given, key, format_number(min), format_number(max));
    value = parsed;
  }
  void on_integer(ParamLevel, const char* key, int& value, int min, int max, const char*) override {
    const Given* given = find(key);
    if (!given) return;
    const double parsed = to_number(*given, key);
    if (parsed != std::floor(parsed)) fail(*given, key, "is not a whole number; write one without decimals");
    if (!(parsed >= min && parsed <= max))
      out_of_range(*given, key, std::to_string(min), std::to_string(max));
    value = int(parsed);
  }
  void on_odd(ParamLevel level, const char* key, int& value, int min, int max, const char* help) override {
    int parsed = value;
    on_integer(level, key, parsed, min, max, help);
    const Given* given = find(key);
    if (given && parsed % 2 == 0) fail(*given, key, "is even; write an odd number");
    value = parsed;
  }
  void on_boolean(ParamLevel, const char* key, bool& value, const char*) override {
    const Given* given = find(key);
    if (!given) return;
    if (given->text != "true" && given->text != "false")
      fail(*given, key, "is neither true nor false; write one of the two");
    value = given->text == "true";
  }
  void on_text(ParamLevel, const char* key, std::string& value, const std::vector<std::string>& choices,
               const char*) override {
    const Given* given = find(key);
    if (!given) return;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), given->text) == choices.end()) {
      std::string list;
      for (const std::string& c : choices) list += (list.empty() ? "" : ", ") + c;
      fail(*given, key,
           "is not one of " + list + "; did you mean " + nearest_name(given->text, choices) + "?");
    }
    value = given->text;
  }
  void begin_group(const char* key) override { prefix_.push_back(prefix() + key); }
  void end_group() override { prefix_.pop_back(); }

 private:
  std::string prefix() const { return prefix_.empty() ? "" : prefix_.back() + "."; }
  const Given* find(const char* key) const {
    const auto it = values_->find(prefix() + key);
    return it == values_->end() ? nullptr : &it->second;
  }
  double to_number(const Given& given, const char* key) const {
    const char* const end = given.text.data() + given.text.size();
    double parsed = 0;
    const auto result = std::from_chars(given.text.data(), end, parsed);
    if (result.ec != std::errc() || result.ptr != end)
      fail(given, key, "is not a number; write one without a unit");
    return parsed;
  }
  [[noreturn]] void fail(const Given& given, const char* key, const std::string& why) const {
    throw InputError(given.where, prefix() + key + ": '" + one_line(given.text) + "' " + why, "");
  }
  [[noreturn]] void out_of_range(const Given& given, const char* key, const std::string& min,
                                 const std::string& max) const {
    fail(given, key, "is out of range; it must be between " + min + " and " + max);
  }

  const GivenValues* values_;
  std::vector<std::string> prefix_;
};

std::string leaf(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// The known key with the same last component, in any group; else the nearest.
std::string suggestion(const std::string& key, const std::vector<std::string>& known) {
  std::vector<std::string> same_leaf;
  for (const std::string& k : known)
    if (leaf(k) == leaf(key)) same_leaf.push_back(k);
  return nearest_name(key, same_leaf.empty() ? known : same_leaf);
}

void check_known(const YamlEntry& entry, const std::string& where, const KeyCollector& known) {
  if (known.knows(entry.key)) {
    if (!entry.has_value) throw InputError(where, entry.key + " has no value", "write `key: value`");
  } else if (!known.groups.count(entry.key)) {
    throw InputError(where, "unknown parameter '" + one_line(entry.key) + "'",
                     "did you mean '" + suggestion(entry.key, known.keys) + "'?");
  } else if (entry.has_value) {
    throw InputError(where, entry.key + " is a group of parameters, not a value",
                     "give its keys, indented, below it");
  }
}

void assign(const std::vector<YamlEntry>& entries, const std::string& file, const VisitParams& visit) {
  KeyCollector known;
  visit(known);
  GivenValues values;
  for (const YamlEntry& entry : entries) {
    const std::string where = entry.line > 0 ? file + ":" + std::to_string(entry.line) : file;
    check_known(entry, where, known);
    if (entry.has_value) values[entry.key] = {entry.value, where};
  }
  Assigner assigner(values);
  visit(assigner);
}

// Converts each value and its range to text and passes them on.
class Describer : public ParamVisitor {
 public:
  void on_number(ParamLevel level, const char* key, double& value, double min, double max,
                 const char* help) override {
    line(
        {level, key, format_number(value), "[" + format_number(min) + ", " + format_number(max) + "]", help});
  }
  void on_integer(ParamLevel level, const char* key, int& value, int min, int max,
                  const char* help) override {
    line({level, key, std::to_string(value), range(min, max), help});
  }
  void on_odd(ParamLevel level, const char* key, int& value, int min, int max, const char* help) override {
    line({level, key, std::to_string(value), range(min, max) + ", odd", help});
  }
  void on_boolean(ParamLevel level, const char* key, bool& value, const char* help) override {
    line({level, key, value ? "true" : "false", "true or false", help});
  }
  void on_text(ParamLevel level, const char* key, std::string& value, const std::vector<std::string>& choices,
               const char* help) override {
    std::string list;
    for (const std::string& c : choices) list += (list.empty() ? "" : " | ") + c;
    line({level, key, yaml_scalar(value), list, help});
  }

 private:
  static std::string range(int min, int max) {
    return "[" + std::to_string(min) + ", " + std::to_string(max) + "]";
  }
  virtual void line(ParamDescription param) = 0;
};

class Writer : public Describer {
 public:
  Writer(int indent, bool comments, ParamLevel last_level)
      : indent_(indent), comments_(comments), last_level_(last_level) {}
  void begin_group(const char* key) override {
    unwritten_.push_back(std::string(indent_, ' ') + key + ":\n");
    indent_ += 2;
  }
  void end_group() override {
    if (!unwritten_.empty()) unwritten_.pop_back();
    indent_ -= 2;
  }
  std::string str() const { return out_.str(); }

 private:
  void line(ParamDescription p) override {
    if (p.level > last_level_) return;
    for (const std::string& group : unwritten_) out_ << group;
    unwritten_.clear();
    out_ << std::string(indent_, ' ') << p.key << ": " << p.value;
    if (comments_) out_ << "  # " << p.help << (p.range.empty() ? "" : "; " + p.range);
    out_ << "\n";
  }
  std::ostringstream out_;
  int indent_;
  bool comments_;
  ParamLevel last_level_;
  std::vector<std::string> unwritten_;  // groups that have begun but have no key yet
};

class Lister : public Describer {
 public:
  void begin_group(const char* key) override { groups_.push_back(key); }
  void end_group() override { groups_.pop_back(); }

  std::vector<ParamDescription> params;

 private:
  void line(ParamDescription p) override {
    std::string path;
    for (const std::string& group : groups_) path += group + ".";
    p.key = path + p.key;
    params.push_back(std::move(p));
  }
  std::vector<std::string> groups_;
};

// Empties all lines but those below the line `head`, which lose their indentation; their numbers stay.
// Returns false if there is no such line.
bool keep_block(const std::string& head, std::string* text) {
  std::istringstream in(*text);
  std::string kept, line;
  bool found = false, inside = false;
  for (size_t indent = 0; std::getline(in, line); kept += '\n') {
    const size_t begin = line.find_first_not_of(' ');
    if (begin == 0 && line.front() != '#') {
      inside = line.substr(0, line.find_last_not_of(" \t\r") + 1) == head;
      found |= inside;
      indent = 0;
    } else if (inside && begin != std::string::npos) {
      if (indent == 0) indent = begin;
      kept += line.substr(std::min(indent, begin));
    }
  }
  if (found) *text = kept;
  return found;
}

}  // namespace

void read_params(const std::string& yaml_text, const std::string& where, const VisitParams& visit) {
  assign(parse_block_yaml(yaml_text, where), where, visit);
}

bool read_params_file(const std::string& path, const VisitParams& visit) {
  std::string text = read_text(path, "give the path of a parameter file such as params/default.yaml");
  KeyCollector known;
  visit(known);
  const bool has_block = known.groups.count("parameters") == 0 && keep_block("parameters:", &text);
  read_params(text, path, visit);
  return has_block;
}

void set_param(const std::string& assignment, const VisitParams& visit) {
  const std::string where = "--set " + one_line(assignment);
  const size_t eq = assignment.find('=');
  if (eq == std::string::npos || eq == 0)
    throw InputError(where, "is not KEY=VALUE", "write for example --set mapping.window.keyframes=9");
  assign({{assignment.substr(0, eq), assignment.substr(eq + 1), true, 0}}, where, visit);
}

std::string write_params(const VisitParams& visit, int indent, bool comments) {
  Writer writer(indent, comments, kExperimental);
  visit(writer);
  return writer.str();
}

std::string write_basic_params(const VisitParams& visit) {
  Writer writer(0, true, kBasic);
  visit(writer);
  return writer.str();
}

std::vector<ParamDescription> describe_params(const VisitParams& visit) {
  Lister lister;
  visit(lister);
  return std::move(lister.params);
}

const char* to_string(ParamLevel level) {
  constexpr const char* kNames[] = {"basic", "advanced", "experimental"};
  return kNames[int(level)];
}

}  // namespace edgevo
