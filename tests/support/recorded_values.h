// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Values that a program computes now against those that were written down once: a text of lines
// "name: value value ...", which a person can read and compare.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"

namespace edgevo::test {

/// The values of one test.
class RecordedValues {
 public:
  /// `tolerance`: relative to the larger of 1 and the recorded value.
  RecordedValues(std::string path, double tolerance) : path_(std::move(path)), tolerance_(tolerance) {}

  /// Adds a line; names are unique and have no colon.
  void add(const std::string& name, const std::vector<double>& values) {
    names_.push_back(name);
    values_[name] = values;
  }

  /// What differs from the file, a line each; empty: nothing. With the environment variable EDGEVO_RECORD
  /// set the file is written instead.
  std::string differences(const std::string& heading) const {
    if (std::getenv("EDGEVO_RECORD")) write(heading);
    std::map<std::string, std::vector<double>> recorded = read();
    std::string text;
    for (const std::string& name : names_) {
      const auto found = recorded.find(name);
      if (found == recorded.end())
        text += "  " + name + " is new\n";
      else if (!is_same(values_.at(name), found->second))
        text += "  " + name + "\n     is " + in_words(values_.at(name)) + "\n    was " +
                in_words(found->second) + "\n";
      recorded.erase(name);
    }
    for (const auto& [name, values] : recorded) text += "  " + name + " is gone\n";
    return text;
  }

 private:
  static std::string in_words(const std::vector<double>& values) {
    std::string text;
    for (const double value : values) {
      char number[32];
      std::snprintf(number, sizeof number, "%.7g", value);
      text += (text.empty() ? "" : " ") + std::string(number);
    }
    return text;
  }

  bool is_same(const std::vector<double>& now, const std::vector<double>& was) const {
    if (now.size() != was.size()) return false;
    for (size_t i = 0; i < now.size(); ++i) {
      if (std::isnan(now[i]) != std::isnan(was[i])) return false;
      if (std::abs(now[i] - was[i]) > tolerance_ * std::max(1.0, std::abs(was[i]))) return false;
    }
    return true;
  }

  void write(const std::string& heading) const {
    OutputFile file(path_);
    file.write(heading);
    for (const std::string& name : names_) file.write(name + ": " + in_words(values_.at(name)) + "\n");
    file.close();
  }

  // Lines that begin with # are comments.
  std::map<std::string, std::vector<double>> read() const {
    std::istringstream lines(read_file(path_, "write it: EDGEVO_RECORD=1 and the same test"));
    std::map<std::string, std::vector<double>> recorded;
    for (std::string line; std::getline(lines, line);) {
      const size_t colon = line.find(':');
      if (line[0] == '#' || colon == std::string::npos) continue;
      std::istringstream numbers(line.substr(colon + 1));
      std::vector<double>& values = recorded[line.substr(0, colon)];
      for (std::string number; numbers >> number;) values.push_back(std::stod(number));
    }
    return recorded;
  }

  std::string path_;
  double tolerance_;
  std::vector<std::string> names_;  // in the order of the file
  std::map<std::string, std::vector<double>> values_;
};

}  // namespace edgevo::test
