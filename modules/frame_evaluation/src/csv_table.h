// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads the program's own tables of comma-separated values by the names of their columns.
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// A table without quoted fields. Rows are read one after the other.
class CsvTable {
 public:
  /// Reads the file and its header. Throws InputError if it cannot be read or is empty; `remedy` ends it.
  CsvTable(std::string path, std::string remedy);
  /// Whether there is such a column.
  bool has(std::string_view column) const { return find(column) >= 0; }
  /// Moves to the next row; false after the last one. Throws InputError for a row of another length.
  bool next();
  /// Field of the row. Throws InputError if there is no such column.
  std::string_view text(std::string_view column) const;
  /// The same as a number; NaN for an empty field or, with `optional`, a column that does not exist. Throws
  /// InputError for anything else.
  double number(std::string_view column, bool optional = false) const;
  /// "FILE:LINE" of the row, for messages.
  std::string where() const { return path_ + ":" + std::to_string(line_); }

 private:
  int find(std::string_view column) const;
  std::string_view take_line();

  std::string path_, remedy_, bytes_;
  std::string_view rest_;
  std::vector<std::string_view> names_, fields_;
  int line_ = 0;
};

}  // namespace edgevo
