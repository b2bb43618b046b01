#pragma once
// What became of the edge pixels of keyframes on their way to lines: for figures, not for results.
#include <map>
#include <string>
#include <vector>

namespace edgevo {

/// The furthest gate that an edge pixel reached, in their order. Up to kFound of its depth, then of the
/// fusion.
enum class EdgeFate {
  kNotTried,     ///< its edge is too short
  kNoCrossing,   ///< no edge of like direction lies on its epipolar lines, and no neighbour's depth fits it
  kFewViews,     ///< fewer than min_views show an edge where any of its depths says
  kNoSupport,    ///< more views look at the place without showing it
  kNoMotion,     ///< no view moves it across its edge
  kNotChosen,    ///< along the edge no depth was cheaper
  kAlongMotion,  ///< an error that all views share makes the depth too uncertain: no neighbour can help
  kUncertain,    ///< the noise does
  kShort,        ///< the stretch with a depth is shorter than min_vertices
  kFound,        ///< it has a depth
  kExplained,    ///< which an earlier line tells as well
  kReplaced,     ///< a later keyframe tells it much better
  kMissed,       ///< more keyframes contradict it than see it
  kUnconfirmed,  ///< only its host tells it, from few images
  kKept,         ///< a vertex of a line
};
/// Its words in tables.
const std::string& to_string(EdgeFate fate);

/// Of an edge pixel.
struct TracedPixel {
  EdgeFate fate = EdgeFate::kNotTried;  ///< furthest gate
  double idepth = 0;  ///< 1/z in the frame of its keyframe, whether it was certain or not; 0: there was none

  /// Notes that the pixel came to this gate.
  void reach(EdgeFate gate) {
    if (gate > fate) fate = gate;
  }
};

/// Of each keyframe by its id, by edge pixel; those between two searched ones (step_px) stay as they began.
using EdgeTrace = std::map<int, std::vector<TracedPixel>>;

}  // namespace edgevo
