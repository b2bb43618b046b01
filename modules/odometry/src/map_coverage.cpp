// SPDX-License-Identifier: BSD-3-Clause
#include "map_coverage.h"

#include <algorithm>

#include "edgevo/odometry/reference.h"

namespace edgevo {
namespace {

// Points of known depth in the reference: fewer may not constrain a translation.
constexpr int kFewKnownPoints = 200;
// Share of the window's points in view: a pure rotation leaves 3 %, bad light 40 % and more.
constexpr double kAwayViewShare = 0.15;
// A frame is explained if all points, also those of guessed depth, lie on edges as well as in view of a map.
constexpr double kExplainedShare = 0.7;       // of the points are matched
constexpr double kExplainedResidualPx = 1.0;  // rms along the normal
constexpr int kManyUnexplained = 12;          // frames; a keyframe may end a shorter interval

// Bad light leaves few points of known depth, too, but they are in view: a new map would see no more of them.
bool is_sparse(const Reference& reference) {
  return reference.known_points < kFewKnownPoints && reference.view_share < kAwayViewShare;
}

bool is_explained(const AlignmentStats& stats) {
  return stats.matched_share() >= kExplainedShare && stats.residual_px <= kExplainedResidualPx;
}

}  // namespace

std::optional<Event> MapCoverage::look(const Reference& reference, const TrackResult& tracked) {
  if (!is_sparse(reference)) {
    unexplained_frames_ = 0;  // fast motion also blurs images of a map that is in view
    return Event::kInView;
  }
  unexplained_frames_ =
      std::clamp(unexplained_frames_ + (is_explained(tracked.stats) ? -1 : 1), 0, 2 * kManyUnexplained);
  if (unexplained_frames_ >= kManyUnexplained && bootstrap_out_of_view_) return Event::kOutOfView;
  return std::nullopt;
}

}  // namespace edgevo
