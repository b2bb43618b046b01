// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Trace of the edge pixels of keyframes on their way to lines: for diagnosis, not for results.
#include <map>
#include <string>
#include <vector>

namespace edgevo {

/// Last stage that an edge pixel reached, in order: up to kFound those of its depth, then those of the
/// fusion.
enum class EdgeStage {
  /// The edge is too short.
  kNotTried,
  /// No edge of like direction lies on its epipolar lines, and the depth of no neighbour fits.
  kNoCrossing,
  /// Fewer than min_views views show an edge at any of its depths.
  kFewViews,
  /// More of the views that contain the point show no edge there than show one.
  kNoSupport,
  /// A change of depth moves the point across its edge in no view.
  kNoMotion,
  /// Having no depth was cheaper along the edge.
  kNotChosen,
  /// The error common to all views makes the depth too uncertain, which neighbours cannot improve.
  kAlongMotion,
  /// Noise makes the depth too uncertain.
  kUncertain,
  /// The piece of the edge with a depth has fewer than min_vertices vertices.
  kShort,
  /// The pixel has a depth.
  kFound,
  /// An earlier line predicts the same depth.
  kExplained,
  /// A later keyframe measures the depth much better.
  kReplaced,
  /// Keyframes see the vertex less than chance would.
  kMissed,
  /// Only the host supports the vertex, from few images.
  kUnconfirmed,
  /// The pixel is a vertex of a line.
  kKept,
};
/// Label of a stage in tables.
const std::string& to_string(EdgeStage stage);

/// Trace of one edge pixel.
struct TracedPixel {
  /// Last stage that the pixel reached.
  EdgeStage stage = EdgeStage::kNotTried;
  /// Inverse depth 1/z in the frame of its keyframe, certain or not; 0 if there is none.
  double idepth = 0;

  /// Records that the pixel reached a stage.
  void reach(EdgeStage reached) {
    if (reached > stage) stage = reached;
  }
};

/// Traces of the edge pixels of each keyframe, by keyframe id; pixels between two searched ones (step_px)
/// keep the initial stage.
using EdgeTrace = std::map<int, std::vector<TracedPixel>>;

}  // namespace edgevo
