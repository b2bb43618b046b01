#pragma once
// What is told of a run besides its records: who requested it, on which source, with which
// parameters.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"

namespace edgevo {

/// What summary.yaml and report.html tell besides the run itself.
struct RunInfo {
  std::vector<std::string> command_line;  ///< program and arguments
  std::string source_kind, source_path;  ///< ImageSource::kind(), and where it lies
  std::string ground_truth_path;  ///< a trajectory file, for report.html; empty if there is none
  Camera camera;                  ///< as given by the source or --camera
  std::string params_yaml;        ///< of write_params(), not indented
  bool interrupted = false;  ///< ended by Ctrl-C or by a source that broke: the run is the part up to there
  std::vector<std::pair<std::string, std::string>> notes;  ///< anything else, as name and text
};

}  // namespace edgevo
