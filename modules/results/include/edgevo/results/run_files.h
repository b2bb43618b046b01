#pragma once
// The files that a run leaves in its folder: names and what they are. Who writes each:
// src/exporters/exporters.cpp.
#include <string>
#include <vector>

namespace edgevo {

struct RunFile {
  std::string name;
  std::string content;
};

/// All of them, in the order in which they are written; some only where the run has what they tell.
std::vector<RunFile> run_files();

}  // namespace edgevo
