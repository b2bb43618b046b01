// SPDX-License-Identifier: BSD-3-Clause
#include "csv_table.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"

namespace edgevo {
namespace {

void split(std::string_view line, std::vector<std::string_view>* fields) {
  fields->clear();
  while (true) {
    const size_t comma = line.find(',');
    fields->push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

CsvTable::CsvTable(std::string path, std::string remedy)
    : path_(std::move(path)), remedy_(std::move(remedy)), bytes_(read_file(path_, remedy_)), rest_(bytes_) {
  split(take_line(), &names_);
  if (names_.size() == 1 && names_[0].empty()) throw InputError(path_, "is empty", remedy_);
}

std::string_view CsvTable::take_line() {
  ++line_;
  const size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool CsvTable::next() {
  if (rest_.empty()) return false;
  split(take_line(), &fields_);
  if (fields_.size() != names_.size()) throw InputError(where(), "the line is incomplete", remedy_);
  return true;
}

int CsvTable::find(std::string_view column) const {
  const auto found = std::find(names_.begin(), names_.end(), column);
  return found == names_.end() ? -1 : int(found - names_.begin());
}

std::string_view CsvTable::text(std::string_view column) const {
  const int at = find(column);
  if (at < 0) throw InputError(path_, "has no column " + std::string(column), remedy_);
  return fields_[size_t(at)];
}

double CsvTable::number(std::string_view column, bool optional) const {
  if (optional && !has(column)) return std::numeric_limits<double>::quiet_NaN();
  const std::string_view field = text(column);
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    throw InputError(where(), std::string(column) + " is not a number", remedy_);
  return value;
}

}  // namespace edgevo
