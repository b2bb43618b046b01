// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The files that a run leaves in its folder: names and contents. The writer of each is listed in
// src/exporters/exporters.cpp.
#include <string>
#include <vector>

namespace edgevo {

/// A file of a run.
struct RunFile {
  /// File name within the run's folder.
  std::string name;
  /// Content of the file, one line for people.
  std::string content;
};

/// All files of a run, in the order of writing. Some are written only if the run has data for them.
std::vector<RunFile> run_files();

}  // namespace edgevo
