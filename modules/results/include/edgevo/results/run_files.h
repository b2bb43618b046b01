#pragma once
// The files that a run leaves in its folder: names and what they are. Who writes each:
// src/exporters/exporters.cpp.
#include <string>
#include <vector>

namespace edgevo {

/// A file of a run.
struct RunFile {
  std::string name;  ///< in the run's folder
  std::string content;  ///< what it is, a line for people
};

/// All of them, in the order in which they are written; some only where the run has what they tell.
std::vector<RunFile> run_files();

}  // namespace edgevo
