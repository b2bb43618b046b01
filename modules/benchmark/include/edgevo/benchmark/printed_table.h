#pragma once
// A table as it is printed, three ways from one value: Markdown to be read, CSV to be used, HTML to be shown.
// The same value gives the same bytes.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/benchmark/bench_table.h"

namespace edgevo {

/// One figure of a table.
struct TableCell {
  std::optional<double> value;        ///< none: `text` stands there, or "-"
  std::optional<double> least, most;  ///< of the trials
  std::string text;                   ///< what is said beside the value, or instead of it
};

/// One row of a table.
struct TableRow {
  std::string name;              ///< stands before the cells
  std::vector<TableCell> cells;  ///< as many as columns
  bool is_own = false;           ///< measured here, not taken from the paper
};

/// A table with what stands around it.
struct PrintedTable {
  std::string title, corner;         ///< corner: the title of the rows' names
  BenchHeader header;                ///< version, machine, ...
  std::vector<std::string> columns;  ///< their titles
  std::vector<TableRow> rows;        ///< from the top
  std::vector<std::string> remarks;  ///< lines below the table
  int decimals = 1;                  ///< of all values
};

/// "1.2 [0.9..1.7]", "1.2", the text, or "-".
std::string cell_text(const TableCell& cell, int decimals);

std::string table_markdown(const PrintedTable& table);  ///< For people: header, table, remarks.
/// The header as comment lines; for each column its value, and `least` and `most` where one of the rows has
/// them.
std::string table_csv(const PrintedTable& table);
/// One page that loads nothing; follows light and dark.
std::string table_html(const PrintedTable& table);

}  // namespace edgevo
