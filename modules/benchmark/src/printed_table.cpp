// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/printed_table.h"

#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

// Quotes a field that contains a comma or quotes.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string number(const std::optional<double>& value, int decimals) {
  return value ? fixed(*value, decimals) : "";
}

bool has_spread(const PrintedTable& table, size_t column) {
  for (const TableRow& row : table.rows)
    if (row.cells[column].least) return true;
  return false;
}

}  // namespace

std::string cell_text(const TableCell& cell, int decimals) {
  if (!cell.value) return cell.text.empty() ? "-" : cell.text;
  std::string text = fixed(*cell.value, decimals);
  if (cell.least && cell.most)
    text += " [" + fixed(*cell.least, decimals) + ".." + fixed(*cell.most, decimals) + "]";
  return cell.text.empty() ? text : text + " (" + cell.text + ")";
}

std::string table_markdown(const PrintedTable& table) {
  std::string text = "# " + table.title + "\n", rule = "|---|";
  for (const auto& [name, value] : table.header) text += "- " + name + ": " + value + '\n';
  text += "\n| " + table.corner + " |";
  for (const std::string& column : table.columns) text += " " + column + " |", rule += "---|";
  text += '\n' + rule + '\n';
  for (const TableRow& row : table.rows) {
    text += "| " + (row.is_ego ? "**" + row.name + "**" : row.name) + " |";
    for (const TableCell& cell : row.cells) text += " " + cell_text(cell, table.decimals) + " |";
    text += '\n';
  }
  for (const std::string& remark : table.remarks) text += "\n" + remark + "\n";
  return text;
}

std::string table_csv(const PrintedTable& table) {
  std::string text;
  for (const auto& [name, value] : table.header) text += "# " + name + ": " + value + '\n';
  text += csv_field(table.corner);
  for (size_t c = 0; c < table.columns.size(); ++c) {
    text += ',' + csv_field(table.columns[c]);
    if (has_spread(table, c))
      text += ',' + csv_field(table.columns[c] + " least") + ',' + csv_field(table.columns[c] + " most");
  }
  text += '\n';
  for (const TableRow& row : table.rows) {
    text += csv_field(row.name);
    for (size_t c = 0; c < row.cells.size(); ++c) {
      const TableCell& cell = row.cells[c];
      text += ',' + (cell.value ? number(cell.value, table.decimals) : csv_field(cell.text));
      if (has_spread(table, c))
        text += ',' + number(cell.least, table.decimals) + ',' + number(cell.most, table.decimals);
    }
    text += '\n';
  }
  return text;
}

std::string table_html(const PrintedTable& table) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(table.title) +
      "</title>\n<style>:root{color-scheme:light dark}body{font:15px "
      "sans-serif;margin:2em}table{border-collapse:collapse}td,th{padding:.3em .6em;border-bottom:1px solid "
      "#8886;text-align:right}td:first-child,th:first-child{text-align:left}.own{font-weight:bold}</style></"
      "head><body>\n<h1>" +
      escaped(table.title) + "</h1>\n<ul>\n";
  for (const auto& [name, value] : table.header)
    text += "<li>" + escaped(name) + ": " + escaped(value) + "</li>\n";
  text += "</ul>\n<table>\n<tr><th>" + escaped(table.corner) + "</th>";
  for (const std::string& column : table.columns) text += "<th>" + escaped(column) + "</th>";
  text += "</tr>\n";
  for (const TableRow& row : table.rows) {
    text += std::string("<tr") + (row.is_ego ? " class=\"own\"" : "") + "><td>" + escaped(row.name) + "</td>";
    for (const TableCell& cell : row.cells)
      text += "<td>" + escaped(cell_text(cell, table.decimals)) + "</td>";
    text += "</tr>\n";
  }
  text += "</table>\n";
  for (const std::string& remark : table.remarks) text += "<p>" + escaped(remark) + "</p>\n";
  return text + "</body></html>\n";
}

}  // namespace edgevo
