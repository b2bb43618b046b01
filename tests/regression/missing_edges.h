#pragma once
// Why true edges are missing in a map of lines: the furthest gate that one of their pixels reached in any
// keyframe.
#include <array>
#include <ostream>
#include <string>

#include "edge_replay.h"
#include "true_edges.h"

namespace edgevo::test {

/// In the order in which a pixel passes them; of several pixels of an edge the furthest counts.
enum class Loss {
  kDetector,  ///< no edge pixel of its direction within two pixels
  kGate,      ///< an edge pixel without depth: which gate, EdgeFate tells
  kDoubted,   ///< an uncertain depth that is right
  kOff,       ///< a depth that is wrong by more than the tolerance
  kFusion,    ///< a depth that is right, and no line in the end
  kPose,      ///< a line that is right in its keyframe's frame, not in the scene
  kThere,     ///< not missing
};

struct EdgeLoss {
  Loss loss = Loss::kDetector;
  EdgeFate fate = EdgeFate::kNotTried;
  bool operator<(const EdgeLoss& o) const { return loss != o.loss ? loss < o.loss : fate < o.fate; }
};
std::string to_string(const EdgeLoss& loss);

/// By reason, cells of true edges that three keyframes saw; shares of all such cells.
std::vector<std::pair<EdgeLoss, double>> missing_edges(const TrueEdges& truth, const EdgeReplay& replay);

/// Writes the image of keyframe `k`, dark, with its true edges: green where they are in the map, else
/// coloured by reason. Throws InputError where the file cannot be written.
void draw_missing_edges(const TrueEdges& truth, const EdgeReplay& replay, int k, const std::string& path);

}  // namespace edgevo::test
