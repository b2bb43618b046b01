#include "edgevo/core/params.h"

#include <mrpt/containers/yaml.h>

#include <cmath>
#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

using Yaml = mrpt::containers::yaml;

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

std::string format_number(double value) {
  std::ostringstream out;
  out.precision(10);
  out << value;
  return out.str();
}

// Gathers the dotted names of all keys, for "did you mean" and for finding unknown ones.
class KeyCollector : public ParamVisitor {
 public:
  void number(const char* key, double&, double, double, const char*) override { add(key); }
  void integer(const char* key, int&, int, int, const char*) override { add(key); }
  void boolean(const char* key, bool&, const char*) override { add(key); }
  void text(const char* key, std::string&, const std::vector<std::string>&, const char*) override { add(key); }
  void begin_group(const char* key) override {
    prefix_.push_back(prefix() + key);
    groups.insert(prefix_.back());
  }
  void end_group() override { prefix_.pop_back(); }

  std::vector<std::string> keys;
  std::set<std::string> groups;

 private:
  std::string prefix() const { return prefix_.empty() ? "" : prefix_.back() + "."; }
  void add(const char* key) { keys.push_back(prefix() + key); }
  std::vector<std::string> prefix_;
};

// Scalars of a YAML document by dotted name, as text.
using Scalars = std::vector<std::pair<std::string, std::string>>;

void flatten(const Yaml& node, const std::string& name, const std::string& where, Scalars* out) {
  if (node.isMap()) {
    for (const auto& [key, value] : node.asMap()) {
      const std::string child = Yaml(key).as<std::string>();
      flatten(Yaml(value), name.empty() ? child : name + "." + child, where, out);
    }
  } else if (node.isScalar()) {
    out->emplace_back(name, node.as<std::string>());
  } else if (!node.isNullNode()) {
    throw InputError(where, name + " holds a list, but every parameter is one value", "write `key: value`");
  }
}

// Writes given texts into the fields of the same dotted name.
class Assigner : public ParamVisitor {
 public:
  Assigner(const Scalars& scalars, std::string where) : where_(std::move(where)) {
    for (const auto& [key, value] : scalars) values_[key] = value;
  }

  void number(const char* key, double& value, double min, double max, const char*) override {
    const std::string* given = find(key);
    if (!given) return;
    const double parsed = to_number(key, *given);
    if (!(parsed >= min && parsed <= max)) out_of_range(key, *given, format_number(min), format_number(max));
    value = parsed;
  }
  void integer(const char* key, int& value, int min, int max, const char*) override {
    const std::string* given = find(key);
    if (!given) return;
    const double parsed = to_number(key, *given);
    if (parsed != std::floor(parsed)) fail(key, *given, "is not a whole number");
    if (!(parsed >= min && parsed <= max)) out_of_range(key, *given, std::to_string(min), std::to_string(max));
    value = int(parsed);
  }
  void boolean(const char* key, bool& value, const char*) override {
    const std::string* given = find(key);
    if (!given) return;
    if (*given != "true" && *given != "false") fail(key, *given, "is neither true nor false");
    value = *given == "true";
  }
  void text(const char* key, std::string& value, const std::vector<std::string>& choices, const char*) override {
    const std::string* given = find(key);
    if (!given) return;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), *given) == choices.end()) {
      std::string list;
      for (const std::string& c : choices) list += (list.empty() ? "" : ", ") + c;
      fail(key, *given, "is not one of " + list + "; did you mean " + nearest_name(*given, choices) + "?");
    }
    value = *given;
  }
  void begin_group(const char* key) override { prefix_.push_back(prefix() + key); }
  void end_group() override { prefix_.pop_back(); }

 private:
  std::string prefix() const { return prefix_.empty() ? "" : prefix_.back() + "."; }
  const std::string* find(const char* key) const {
    const auto it = values_.find(prefix() + key);
    return it == values_.end() ? nullptr : &it->second;
  }
  double to_number(const char* key, const std::string& given) const {
    size_t used = 0;
    double parsed = 0;
    try {
      parsed = std::stod(given, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || used != given.size()) fail(key, given, "is not a number");
    return parsed;
  }
  [[noreturn]] void fail(const char* key, const std::string& given, const std::string& why) const {
    throw InputError(where_, prefix() + key + ": '" + one_line(given) + "' " + why, "");
  }
  [[noreturn]] void out_of_range(const char* key, const std::string& given, const std::string& min,
                                 const std::string& max) const {
    fail(key, given, "is out of range; it must be between " + min + " and " + max);
  }

  std::string where_;
  std::map<std::string, std::string> values_;
  std::vector<std::string> prefix_;
};

void assign(const Scalars& scalars, const std::string& where, const VisitParams& visit) {
  KeyCollector known;
  visit(known);
  for (const auto& [key, value] : scalars) {
    if (std::find(known.keys.begin(), known.keys.end(), key) != known.keys.end()) continue;
    if (known.groups.count(key))
      throw InputError(where, key + " is a group of parameters, not a value", "give its keys, indented, below it");
    throw InputError(where, "unknown parameter '" + one_line(key) + "'",
                     "did you mean '" + nearest_name(key, known.keys) + "'?");
  }
  Assigner assigner(scalars, where);
  visit(assigner);
}

class Writer : public ParamVisitor {
 public:
  Writer(int indent, bool comments) : indent_(indent), comments_(comments) {}
  void number(const char* key, double& value, double min, double max, const char* help) override {
    line(key, format_number(value), help, "[" + format_number(min) + ", " + format_number(max) + "]");
  }
  void integer(const char* key, int& value, int min, int max, const char* help) override {
    line(key, std::to_string(value), help, "[" + std::to_string(min) + ", " + std::to_string(max) + "]");
  }
  void boolean(const char* key, bool& value, const char* help) override {
    line(key, value ? "true" : "false", help, "true or false");
  }
  void text(const char* key, std::string& value, const std::vector<std::string>& choices, const char* help) override {
    std::string list;
    for (const std::string& c : choices) list += (list.empty() ? "" : " | ") + c;
    line(key, value.empty() ? "''" : value, help, list);
  }
  void begin_group(const char* key) override {
    out_ << std::string(indent_, ' ') << key << ":\n";
    indent_ += 2;
  }
  void end_group() override { indent_ -= 2; }
  std::string str() const { return out_.str(); }

 private:
  void line(const char* key, const std::string& value, const char* help, const std::string& range) {
    out_ << std::string(indent_, ' ') << key << ": " << value;
    if (comments_) out_ << "  # " << help << (range.empty() ? "" : "; " + range);
    out_ << "\n";
  }
  std::ostringstream out_;
  int indent_;
  bool comments_;
};

}  // namespace

void read_params(const std::string& yaml_text, const std::string& where, const VisitParams& visit) {
  Scalars scalars;
  try {
    if (yaml_text.find_first_not_of(" \t\r\n") == std::string::npos) return;
    flatten(Yaml::FromText(yaml_text), "", where, &scalars);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(where, "is not readable as YAML", "check indentation and colons");
  }
  assign(scalars, where, visit);
}

void read_params_file(const std::string& path, const VisitParams& visit) {
  std::ifstream in(path);
  std::stringstream text;
  if (!in || !(text << in.rdbuf()))
    throw InputError(path, "cannot be read", "give the path of a parameter file such as params/default.yaml");
  read_params(text.str(), path, visit);
}

void set_param(const std::string& assignment, const VisitParams& visit) {
  const size_t eq = assignment.find('=');
  if (eq == std::string::npos || eq == 0)
    throw InputError("--set " + assignment, "is not KEY=VALUE", "write for example --set mapping.window=9");
  assign({{assignment.substr(0, eq), assignment.substr(eq + 1)}}, "--set " + assignment, visit);
}

std::string write_params(const VisitParams& visit, int indent, bool comments) {
  Writer writer(indent, comments);
  visit(writer);
  return writer.str();
}

}  // namespace edgevo
