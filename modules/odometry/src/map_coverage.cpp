#include "map_coverage.h"

#include <algorithm>

#include "edgevo/odometry/reference.h"

namespace edgevo {
namespace {

constexpr int kFewKnownPoints = 200;  // of known depth in the reference; fewer may not hold a translation
constexpr double kAwayViewShare =
    0.15;  // of the window's points in view: a turn on the spot leaves 3 %, bad light 40 % and more
// A frame is explained where all points, those of guessed depth too, lie on edges as they do in view of a
// map.
constexpr double kExplainedShare = 0.7;       // of the points, matched
constexpr double kExplainedResidualPx = 1.0;  // rms along the normal
constexpr int kManyUnexplained = 12;          // frames; a keyframe may mend a shorter stretch

// Bad light leaves few points of known depth, too, but they are in view: a new map would see no more of them.
bool is_thin(const Reference& reference) {
  return reference.known_points < kFewKnownPoints && reference.view_share < kAwayViewShare;
}

bool is_explained(const AlignmentStats& stats) {
  return stats.matched_share() >= kExplainedShare && stats.residual_px <= kExplainedResidualPx;
}

}  // namespace

std::optional<Event> MapCoverage::look(const Reference& reference, const TrackResult& tracked) {
  if (!is_thin(reference)) {
    unexplained_frames_ = 0;  // fast motion blurs images of a map that is in view, too
    return Event::kInView;
  }
  unexplained_frames_ =
      std::clamp(unexplained_frames_ + (is_explained(tracked.stats) ? -1 : 1), 0, 2 * kManyUnexplained);
  if (unexplained_frames_ >= kManyUnexplained && bootstrap_out_of_view_) return Event::kOutOfView;
  return std::nullopt;
}

}  // namespace edgevo
