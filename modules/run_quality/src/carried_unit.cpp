// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/carried_unit.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

// Error of the positions that the points of a view share, pixels: what remains of the poses' (measured on
// rendered turns by 90 to 360 degrees at 10 to 60 degrees a second: 1 to 14 % off, 2 to 11 % expected).
constexpr double kSharedErrorPx = 0.2;
// Uncertainty of a unit that is said; what carries it to a tenth of that is no pure rotation.
constexpr double kSaidSigma = 0.05, kCarriedSigma = 0.1 * kSaidSigma;

using Frames = std::vector<const FrameRecord*>;

double angle_between(const FrameRecord& a, const FrameRecord& b) {
  return a.T_world_cam->rotation().angularDistance(b.T_world_cam->rotation());
}

// From one half of the view to the next: frames first .. last by their positions.
struct HandOver {
  size_t first = 0, last = 0;
  double sigma = 0;
};

double sigma_of(const Frames& frames, size_t first, size_t last, double focal_px) {
  double baseline = 0;
  std::vector<double> depths;
  for (size_t k = first; k <= last; ++k) {
    const Eigen::Vector3d moved =
        frames[k]->T_world_cam->translation() - frames[first]->T_world_cam->translation();
    baseline = std::max(baseline, moved.norm());
    if (frames[k]->evidence.median_depth > 0) depths.push_back(frames[k]->evidence.median_depth);
  }
  if (depths.empty()) return 0;
  const double parallax_px = focal_px * baseline / median(std::move(depths));
  return kSharedErrorPx / std::max(parallax_px, kSharedErrorPx);  // unknown at most
}

std::vector<HandOver> hand_overs(const Run& run, const Frames& frames) {
  const double half_view = std::atan(0.5 * run.pinhole.width / run.pinhole.fx);
  std::vector<HandOver> found;
  for (size_t first = 0, i = 1; i < frames.size(); ++i) {
    if (frames[i]->segment != frames[first]->segment) first = i;
    if (angle_between(*frames[first], *frames[i]) < half_view) continue;
    found.push_back({first, i, sigma_of(frames, first, i, run.pinhole.fx)});
    first = i;
  }
  return found;
}

bool is_linked_over(const Run& run, const PureRotation& turn) {
  return std::any_of(run.constraints.begin(), run.constraints.end(), [&](const ConstraintRecord& c) {
    const auto [before, after] = std::minmax(c.from_frame, c.to_frame);
    return c.holds && before <= turn.first_frame && after >= turn.last_frame;
  });
}

}  // namespace

std::vector<PureRotation> pure_rotations(const Run& run) {
  // The depths of a map of another unit than the path's, metres, say nothing about it.
  if (run.is_metric() || !(run.pinhole.fx > 0)) return {};
  Frames frames;
  for (const FrameRecord& frame : run.frames)
    if (frame.T_world_cam) frames.push_back(&frame);
  std::vector<PureRotation> turns;
  bool goes_on = false;
  for (const HandOver& h : hand_overs(run, frames)) {
    const bool was_turning = goes_on && turns.back().last_frame == frames[h.first]->index;
    goes_on = h.sigma > kCarriedSigma;
    if (!goes_on) continue;
    if (!was_turning) turns.push_back({frames[h.first]->index, 0, 0, 0});
    PureRotation& turn = turns.back();
    turn.last_frame = frames[h.last]->index;
    turn.angle_rad += angle_between(*frames[h.first], *frames[h.last]);
    turn.sigma = std::hypot(turn.sigma, h.sigma);
  }
  turns.erase(
      std::remove_if(turns.begin(), turns.end(),
                     [&](const PureRotation& t) { return t.sigma < kSaidSigma || is_linked_over(run, t); }),
      turns.end());
  return turns;
}

std::string to_string(const PureRotation& turn) {
  return formatted(
      "frames %d to %d: a pure rotation by %.0f degrees: the unit of length after it is that "
      "before to %.0f %%",
      turn.first_frame, turn.last_frame, deg(turn.angle_rad), 100 * turn.sigma);
}

}  // namespace edgevo
