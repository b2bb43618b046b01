// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Contents of a file, whole and in pieces.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace edgevo::test {

/// Contents of a file; empty if it does not exist.
inline std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Cells of a CSV row whose cells contain no comma.
inline std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells(1);
  for (char c : row)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

}  // namespace edgevo::test
