// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A table as a value, printed as Markdown, CSV or HTML. The same value gives the same bytes.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/benchmark/bench_table.h"

namespace edgevo {

/// One figure of a table.
struct TableCell {
  /// Value; nullopt: the cell is `text`, or "-".
  std::optional<double> value;
  /// Minimum and maximum over the trials.
  std::optional<double> least, most;
  /// Text next to the value, or instead of it.
  std::string text;
};

/// One row of a table.
struct TableRow {
  /// Name in the first column.
  std::string name;
  /// Cells, one for each column.
  std::vector<TableCell> cells;
  /// Whether the figures are ours, not those of the paper.
  bool is_ego = false;
};

/// A table with title, header and remarks.
struct PrintedTable {
  /// Title of the table, and title of the first column.
  std::string title, corner;
  /// Header: version, machine, ...
  BenchHeader header;
  /// Titles of the columns.
  std::vector<std::string> columns;
  /// Rows from the top.
  std::vector<TableRow> rows;
  /// Remarks below the table.
  std::vector<std::string> remarks;
  /// Number of decimals of all values.
  int decimals = 1;
};

/// Text of a cell: "1.2 [0.9..1.7]", "1.2", its text, or "-".
std::string cell_text(const TableCell& cell, int decimals);

/// Table as Markdown: header, table, remarks.
std::string table_markdown(const PrintedTable& table);
/// Table as CSV: the header as comment lines; for each column the value, and `least` and `most` if one of the
/// rows has them.
std::string table_csv(const PrintedTable& table);
/// Table as a self-contained HTML page, with light and dark mode.
std::string table_html(const PrintedTable& table);

}  // namespace edgevo
