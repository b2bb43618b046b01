// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files of the tests as strict_mcap.py reads them, which shares no code with the writer.
#include <sys/wait.h>

#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

namespace edgevo::test {

/// Exit code and output of strict_mcap.py.
struct StrictReading {
  int code = -1;
  std::string text;
};

inline StrictReading read_strictly(const std::string& arguments) {
  const std::string command =
      "/usr/bin/python3 " EDGEVO_SOURCE_DIR "/tests/unit/mcap_output/strict_mcap.py " + arguments + " 2>&1";
  StrictReading reading;
  std::FILE* pipe = popen(command.c_str(), "r");
  char buffer[4096];
  for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) reading.text.append(buffer, n);
  reading.code = WEXITSTATUS(pclose(pipe));
  return reading;
}

/// Fields of the messages of a topic, as words; one row for each message.
inline std::vector<std::vector<std::string>> table_of(const std::string& path, const std::string& topic,
                                                      const std::string& fields) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(read_strictly("table " + path + " " + topic + " " + fields).text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    rows.emplace_back();
    for (std::string word; words >> word;) rows.back().push_back(word);
  }
  return rows;
}

/// The same as numbers.
inline std::vector<std::vector<double>> numbers_of(const std::string& path, const std::string& topic,
                                                   const std::string& fields) {
  std::vector<std::vector<double>> rows;
  for (const auto& words : table_of(path, topic, fields)) {
    rows.emplace_back();
    for (const std::string& word : words) rows.back().push_back(std::stod(word));
  }
  return rows;
}

}  // namespace edgevo::test
