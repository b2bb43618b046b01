// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The probability that the motion of the last ten frames is right, from tests that fail differently. Each
// measures one thing that speaks against the motion (ConsistencyTest), as a number without ramps:
// the log odds that a measured error, with its standard deviation, is beyond the tolerance, or the logarithm
// of a size. The log odds of a wrong motion are a sum of these with weights of at least 0: more inconsistency
// never makes p_right larger. The weights are fitted to runs with ground truth by
// share/training/fit_trust.cpp and are in src/trust_table.h.
//
// "Right" is what core/motion_tolerance.h calls so: over ten frames, the translation in the scale of the
// fifty before, and the rotation.
#include <array>
#include <cmath>
#include <limits>

#include "edgevo/confidence/status_params.h"
#include "edgevo/confidence/zoom_change.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/core/motion_history.h"
#include "edgevo/core/motion_tolerance.h"
#include "edgevo/core/reason.h"
#include "edgevo/core/recent_values.h"

namespace edgevo {

/// What can speak against a motion.
enum class ConsistencyTest {
  /// The motion as reported differs from that of corners that are followed: log odds.
  kCorners,
  /// The camera turns, and hardly moves: an error in proportion to the turn hides the translation. Log odds.
  kTurn,
  /// Steps longer or shorter than usual, in the unit of the map: log ratio, the root mean square of ten
  /// frames, or that of the newest one if it is longer by more.
  kStep,
  /// Edges lie far from where map and pose put them: log of pixels. What fits neither is rejected, what fits
  /// badly stays.
  kResidual,
  /// The image hardly constrains a direction of the pose: decades of its largest standard deviation (median
  /// depths or radians).
  kInformation,
  /// The motion as reported differs from that which was tracked from frame to frame: adjustments of keyframes
  /// have moved the map under the camera. Log of tolerances, the largest of ten frames: a map that has just
  /// been moved was wrong before.
  kMap,
};
/// Number of tests.
inline constexpr size_t kConsistencyTests = 6;
/// A value for each test, in the order of the enum; that of right motions where nothing is known, but for
/// kInformation: a pose without a covariance is as uncertain as the view is deep.
using Inconsistencies = std::array<double, kConsistencyTests>;

/// A frame that has a pose, as the trust in it is built.
struct ConfidenceInput {
  /// Evidence.
  const FrameEvidence& evidence;
  /// Its motion, in the unit of FrameEvidence::median_depth.
  MotionHistory::Newest motion;
  /// The motion over ten frames that a lens that zooms has feigned.
  FeignedMotion by_zoom = {};
};

/// Confidence in a frame.
struct FrameConfidence {
  /// Probability that the motion of the last ten frames is right, 0 to 1.
  double p_right = 0;
  /// What speaks against it.
  Inconsistencies doubts{};
  /// Probability that a wrong focal length, which no other test sees, has bent the turn.
  double p_wrong_focal_length = 0;
  /// Probability that a focal length that changes has feigned a translation beyond the tolerance.
  double p_wrong_zoom = 0;
  /// Standard deviation of the logarithm of the unit of length that the map has carried over the last fifty
  /// frames, and the probability that it is off by more than the tolerance of a length.
  double unit_sigma = 0, p_wrong_unit = 0;
  /// The largest contribution, if the motion is doubted.
  Reasons reasons;
};

/// Builds the trust in each frame from its evidence and from what is usual in the run so far. For the
/// tracking thread; deterministic. Cost: 10 us a frame.
class MotionConfidence {
 public:
  /// Nothing is usual yet.
  explicit MotionConfidence(const ConfidenceParams& params = {}) : params_(params) {}
  /// Adds a frame with a pose, in time order.
  FrameConfidence add(const ConfidenceInput& frame);
  /// A new map begins, whose unit is another one.
  void begin_map() {
    unit_variances_.clear();
    new_variance_ = 0;
  }
  /// Adds what the adjustment of a keyframe showed of the unit; it counts from the next frame on.
  void add_adjustment(const AdjustmentEvidence& adjustment) { new_variance_ += adjustment.unit_variance; }

 private:
  /// A doubt is the mean over so many frames: as long as the motion that counts.
  static constexpr size_t kFrames = size_t(kMotionTolerance.frames);
  double unusual_steps(double change);
  double carried_unit_sigma();

  ConfidenceParams params_;
  RecentValues decades_{kFrames}, moved_{kFrames}, residuals_{kFrames}, squared_changes_{kFrames};
  // By how much the unit has grown less certain, by frame: variances of its logarithm.
  RecentValues unit_variances_{MotionHistory::kUsualSteps};
  double new_variance_ = 0;  // since the newest frame
};

/// Probability of a right motion given the results of the tests, and that of a cause that none of them sees,
/// 0 to 1.
double p_right(const Inconsistencies& doubts, double p_wrong_otherwise = 0);

}  // namespace edgevo
