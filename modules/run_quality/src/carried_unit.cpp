// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/carried_unit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edgevo/core/angle.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/motion_history.h"

namespace edgevo {
namespace {

// Uncertainty of a unit that is said; a keyframe that adds less than a tenth of it is none of a pure
// rotation.
constexpr double kSaidSigma = 0.05, kCarriedSigma = 0.1 * kSaidSigma;
// Frames without such a keyframe after which it has ended: that a unit is compared over (MotionHistory).
constexpr int kEndFrames = int(MotionHistory::kUsualSteps);

double angle_between(const FrameRecord& a, const FrameRecord& b) {
  return a.T_world_cam->rotation().angularDistance(b.T_world_cam->rotation());
}

// By how much the unit is less certain after keyframe `k` than before it: variance of its logarithm.
double added_variance(const FrameRecord& k) {
  return k.evidence.adjustment ? k.evidence.adjustment->unit_variance : 0;
}

bool is_linked_over(const Run& run, const PureRotation& turn) {
  return std::any_of(run.constraints.begin(), run.constraints.end(), [&](const ConstraintRecord& c) {
    const auto [before, after] = std::minmax(c.from_frame, c.to_frame);
    return c.holds && before <= turn.first_frame && after >= turn.last_frame;
  });
}

}  // namespace

std::vector<PureRotation> pure_rotations(const Run& run) {
  std::vector<PureRotation> turns;
  const FrameRecord* before = nullptr;  // the keyframe before
  double turned = 0;                    // since the newest turn ended
  int segment = -1;                     // of the newest turn
  for (const FrameRecord& k : run.frames) {
    if (!k.T_world_cam || !k.evidence.adjustment) continue;
    const FrameRecord& from = before && before->segment == k.segment ? *before : k;
    before = &k;
    turned += angle_between(from, k);
    if (added_variance(k) < kCarriedSigma * kCarriedSigma) continue;
    const bool goes_on =
        !turns.empty() && segment == k.segment && from.index - turns.back().last_frame < kEndFrames;
    if (!goes_on) turns.push_back({from.index, 0, 0, 0}), turned = angle_between(from, k);
    segment = k.segment;
    PureRotation& turn = turns.back();
    turn.last_frame = k.index;
    turn.angle_rad += std::exchange(turned, 0);
    turn.sigma = std::hypot(turn.sigma, std::sqrt(added_variance(k)));
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
