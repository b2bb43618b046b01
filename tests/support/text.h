#pragma once
// What a written file holds, in pieces.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace edgevo::test {

/// All of a file; empty if it is not there.
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

/// Of a row of a table whose cells hold no comma.
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
