// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The probability that the motion of the last ten frames is right, from tests that fail differently. Each
// measures one thing that speaks against the motion (ConsistencyTest), as a number from 0 (nothing) to 3 that
// grows with the suspicion. The sum of these, with weights of at least 0, goes through a table that makes it
// a probability: more inconsistency never makes p_right larger. Weights and table are fitted to runs with
// ground truth by share/training/fit_trust.cpp and are in src/trust_table.h.
//
// "Right" is what core/motion_tolerance.h calls so: over ten frames, the translation in the scale of the
// fifty before, and the rotation.
#include <array>
#include <cmath>
#include <limits>

#include "edgevo/confidence/status_params.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/core/motion_history.h"
#include "edgevo/core/motion_tolerance.h"
#include "edgevo/core/reason.h"
#include "edgevo/core/recent_values.h"

namespace edgevo {

/// What can speak against a motion.
enum class ConsistencyTest {
  /// The motion over ten frames differs from that of the corners: share of its length, and degrees.
  kMotion,
  /// A focal length that the matches contradict has bent the turn: degrees.
  kFocalLength,
  /// Corners break the epipolar constraint.
  kCornerAgreement,
  /// There are too few corners, or they move too little, to check the motion; more if the image hardly
  /// constrains a direction of the pose, either.
  kNoCrossCheck,
  /// The camera turns, and hardly moves: an error in proportion to the turn hides the translation.
  kTurn,
  /// Steps longer or shorter than usual, in the unit of the map.
  kStep,
  /// Edges lie far from where map and pose put them: what fits neither is rejected, what fits badly stays.
  kResidual,
  /// The adjustment moves keyframes by more than tracking thought possible.
  kAdjustment,
  /// Few inliers, few points of known depth, or little of the map in view.
  kStarvation,
  /// Blurred or saturated images.
  kImage,
};
/// Number of doubts.
inline constexpr size_t kConsistencyTests = 10;
/// A value for each doubt, in the order of the enum, 0 to 3.
using Inconsistencies = std::array<double, kConsistencyTests>;

/// A frame that has a pose, as the trust in it is built.
struct ConfidenceInput {
  /// Evidence; its adjustment is not read.
  const FrameEvidence& evidence;
  /// Segment of the map.
  int segment = 0;
  /// Its motion, in the unit of FrameEvidence::median_depth.
  MotionHistory::Newest motion;
  /// The step over the usual one as the run reports it (MotionHistory::reported_ratio): a unit that is set
  /// back, or that of a new segment, changes it. NaN: not known.
  double times_usual_live = std::numeric_limits<double>::quiet_NaN();
};

/// Confidence in a frame.
struct FrameConfidence {
  /// Probability that the motion of the last ten frames is right, 0 to 1.
  double p_right = 0;
  /// What speaks against it.
  Inconsistencies doubts{};
  /// The largest contribution, if the motion is doubted.
  Reasons reasons;
  /// Whether the step is longer than StepGateParams::times the median of the 50 before, in the unit of the
  /// map or as the run reports it: the frame is not TRACKING, even if it starts from a standstill, which does
  /// not make it unlikely.
  bool is_step_outlier = false;
};

/// Builds the trust in each frame from its evidence and from what is usual in the run so far. For the
/// tracking thread; deterministic. Cost: 10 us a frame.
class MotionConfidence {
 public:
  /// Nothing is usual yet.
  explicit MotionConfidence(const ConfidenceParams& params = {});
  /// Adds a frame with a pose, in time order.
  FrameConfidence add(const ConfidenceInput& frame);
  /// Adds what the adjustment of a keyframe showed; it counts from the next frame on. Adjustments come in the
  /// order of their keyframes.
  void add_adjustment(const AdjustmentEvidence& adjustment) { moved_.add(adjustment.moved); }

 private:
  /// A doubt is the mean over so many frames: as long as the motion that counts.
  static constexpr size_t kFrames = size_t(kMotionTolerance.frames);
  /// What the map is to blame for stays longer.
  static constexpr size_t kMapFrames = 20;
  /// What is usual is the median over so many frames.
  static constexpr size_t kUsualFrames = 200;
  /// What a turn does to the translation is the median over so many turning frames.
  static constexpr size_t kTurnErrors = 50;

  ConfidenceParams params_;
  int segment_ = -1;
  RecentValues blurs_{kUsualFrames}, saturated_{kUsualFrames};
  RecentValues turn_errors_{kTurnErrors};
  RecentValues weak_{kFrames}, starvation_{kFrames}, image_{kFrames}, residuals_{kMapFrames};
  RecentValues moved_{3};
};

/// Probability of a right motion at a weighted sum of doubts.
struct CalibrationKnot {
  /// The sum, and the probability, 0 to 1.
  double sum = 0, p_right = 1;
};
/// Probability at a sum: linear between `count` knots of ascending sum, constant outside.
double p_right_at(const CalibrationKnot* knots, size_t count, double sum);

/// Probability of a right motion given the results of the tests, 0 to 1: that of their sum, at most
/// p_right_limit().
double p_right(const Inconsistencies& doubts, const VetoParams& veto = {});
/// VetoParams::p_right where one test has a veto, else 1. Corners that contradict the motion by far, 1.6
/// times what makes it wrong beyond their standard deviation, do: where a map turns over, every other test is
/// content. So does a focal length that makes it wrong: nothing else sees that. And no independent
/// cross-check is a veto: without corners and without information from the image.
double p_right_limit(const Inconsistencies& doubts, const VetoParams& veto = {});

}  // namespace edgevo
