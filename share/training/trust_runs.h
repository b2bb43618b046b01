// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The runs of a corpus, as the trust in their frames is fitted to them: the doubts that the program had,
// found again from the evidence in frames.csv by the program's own code, and their evaluation against the truth.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/frame_evaluation/evaluate_frames.h"
#include "edgevo/confidence/motion_confidence.h"

namespace edgevo::training {

/// One run with ground truth.
struct TrustRun {
  /// Name of the folder, and of the camera that took the images.
  std::string name, camera;
  /// What the run said about each frame, with live poses. The state is that by the image alone.
  std::vector<ReportedFrame> reported;
  /// Inconsistencies of each frame that the trust was built for.
  std::vector<std::optional<Inconsistencies>> doubts;
  /// Probability of a cause that no test sees (a wrong focal length, a unit carried badly), of each frame.
  std::vector<double> p_wrong_otherwise;
  /// Ground truth.
  Trajectory truth;
  /// Evaluation of the live poses; noticed and alarm are those by the image alone.
  FrameEvaluation evaluation;
};

/// Reads the runs of a list written by trust_corpus.py: folder, ground truth and camera on each line,
/// separated by blanks. Throws InputError for a file that is missing or broken.
std::vector<TrustRun> read_trust_runs(const std::string& list);

}  // namespace edgevo::training
