// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Why true edges are missing in a map of lines: the last stage that one of their pixels reached in any
// keyframe.
#include <array>
#include <ostream>
#include <string>

#include "edge_replay.h"
#include "true_edges.h"

namespace edgevo::test {

/// Reason for which a true edge is missing, in the order of the pipeline; of several pixels of an edge, the
/// one that got furthest counts.
enum class Loss {
  /// The detector found no edge pixel of this direction within two pixels.
  kDetector,
  /// The edge pixel got no depth; EdgeStage is the stage that rejected it.
  kGate,
  /// The depth was right but rejected as uncertain.
  kDoubted,
  /// The depth was wrong by more than the tolerance.
  kOff,
  /// The depth was right, but fusion made no line of it.
  kFusion,
  /// The line was right in the frame of its keyframe, but not in the scene.
  kPose,
  /// The edge is in the map.
  kThere,
};

struct EdgeLoss {
  Loss loss = Loss::kDetector;
  EdgeStage stage = EdgeStage::kNotTried;
  bool operator<(const EdgeLoss& o) const { return loss != o.loss ? loss < o.loss : stage < o.stage; }
};
std::string to_string(const EdgeLoss& loss);

/// Shares of the cells of true edges that at least three keyframes saw, by reason.
std::vector<std::pair<EdgeLoss, double>> missing_edges(const TrueEdges& truth, const EdgeReplay& replay);

/// Writes the darkened image of keyframe `k` with its true edges: green where they are in the map, else
/// coloured by reason. Throws InputError where the file cannot be written.
void draw_missing_edges(const TrueEdges& truth, const EdgeReplay& replay, int k, const std::string& path);

}  // namespace edgevo::test
