#pragma once
// Several runs on one page: a table that sorts, the worst first, a picture of each path, and the paths of the
// runs that share a ground truth laid over each other. One file that needs nothing but a browser.
#include <string>
#include <vector>

#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// A run as the page needs it.
struct ComparedRun {
  std::string name;          ///< unlike that of the others
  std::string problem;       ///< why it cannot be compared; then only the name counts
  std::string source;        ///< what was run
  std::string link;          ///< its own page, as a URL relative to this one; empty: it has none
  std::string ground_truth;  ///< a trajectory file; empty: not known. One that cannot be read or compared is
                             ///< told in the row
  int frames = 0, lost = 0, keyframes = 0, segments = 0;  ///< counts of the run
  double cpu_ms = 0;  ///< a frame
  Trajectory
      trajectory;  ///< final poses, T_world_cam; `path` tells where frames.csv lies (find_input_frames)
};

/// For one run or hundreds: 2 kB each, and 5 kB of the first 40 that share a ground truth. Figures are those
/// of `edgevo eval`. Cost: that of evaluate() for each.
std::string compare_html(const std::vector<ComparedRun>& runs);

}  // namespace edgevo
