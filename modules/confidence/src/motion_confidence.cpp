// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/motion_confidence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "consistency_tests.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/motion_tolerance.h"
#include "trust_table.h"

namespace edgevo {
namespace {

// p_right where one doubt decides alone.
constexpr double kAtMostInDoubt = 0.1;

static_assert(trust_table::kDoubtfulBelow == kDoubtfulBelow, "copy it to core/doubtful_frame.h");
static_assert(kAtMostInDoubt < kDoubtfulBelow, "such a frame is doubtful");

// A step over the usual one, or over what is a small one for a camera that has stood still.
double times_likely(double step, double usual, double median_depth) {
  constexpr double kSmallShare = 0.002;
  const double small = std::isfinite(median_depth) ? kSmallShare * median_depth : 0.0;
  return step / std::max(usual, small);
}

// Decimal logarithm of a standard deviation of the pose; an unknown one is not a small one.
double decades_of(double pose_sigma) { return std::isfinite(pose_sigma) ? std::log10(pose_sigma) : 0.0; }

double weighted_sum(const Inconsistencies& doubts) {
  double sum = 0;
  for (const trust_table::Term& term : trust_table::kTerms) sum += term.weight * doubts[size_t(term.doubt)];
  return sum;
}

// The value of a doubt from which on it decides alone.
double decisive(ConsistencyTest doubt) {
  constexpr double kContradiction = 1.6;  // no right frame of the corpus on a camera that moves evenly
  switch (doubt) {
    case ConsistencyTest::kMotion:
      return kContradiction;
    case ConsistencyTest::kFocalLength:
      return 1;
    case ConsistencyTest::kNoCrossCheck:
      return kMaxInconsistency;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

bool is_veto(ConsistencyTest doubt, const Inconsistencies& doubts) {
  return doubts[size_t(doubt)] >= decisive(doubt);
}

ConsistencyTest largest_contribution(const Inconsistencies& doubts) {
  for (const ConsistencyTest doubt :
       {ConsistencyTest::kMotion, ConsistencyTest::kFocalLength, ConsistencyTest::kNoCrossCheck})
    if (is_veto(doubt, doubts)) return doubt;
  const auto most = std::max_element(
      trust_table::kTerms.begin(), trust_table::kTerms.end(), [&](const auto& a, const auto& b) {
        return a.weight * doubts[size_t(a.doubt)] < b.weight * doubts[size_t(b.doubt)];
      });
  return most->doubt;
}

Reason reason_by_scale(const CornerEvidence& c) {
  const bool sudden = !(std::abs(c.change_10) < std::abs(c.change_50));
  const double change = sudden ? c.change_10 : c.change_50;
  return {ReasonKind::kScaleByCorners, std::exp(-change), sudden ? 10.0 : 50.0};
}

Reason reason_by_motion(const CornerEvidence& c) {
  if (inconsistency_of_corner_scale(c) >= 1) return reason_by_scale(c);
  if (c.rotation_deg > kMotionTolerance.rotation_deg) return {ReasonKind::kRotationByCorners, c.rotation_deg};
  return {ReasonKind::kMotionByCorners, c.motion_error};
}

Reason reason_of(ConsistencyTest doubt, const FrameEvidence& e) {
  const CornerEvidence c = e.corners.value_or(CornerEvidence());
  switch (doubt) {
    case ConsistencyTest::kMotion:
      return reason_by_motion(c);
    case ConsistencyTest::kFocalLength:
      return {ReasonKind::kFocalLength, e.focal_error};
    case ConsistencyTest::kCornerAgreement:
      return {ReasonKind::kCornersContradict, 1 - c.agreeing_share};
    case ConsistencyTest::kNoCrossCheck:
      return {ReasonKind::kFewCornersToCheck, double(c.tracks)};
    case ConsistencyTest::kTurn:
      return {ReasonKind::kTurn};
    case ConsistencyTest::kStep:
      return {ReasonKind::kSteps};
    case ConsistencyTest::kResidual:
      return {ReasonKind::kResidual, e.residual_px};
    case ConsistencyTest::kAdjustment:
      return {ReasonKind::kAdjustment};
    case ConsistencyTest::kStarvation:
      return {ReasonKind::kStarvation, double(e.known_points.value_or(0)), e.inlier_share};
    case ConsistencyTest::kImage:
      break;
  }
  return {ReasonKind::kImage};
}

}  // namespace

double p_right_at(const CalibrationKnot* knots, size_t count, double sum) {
  if (sum <= knots[0].sum) return knots[0].p_right;
  for (size_t i = 1; i < count; ++i) {
    if (sum > knots[i].sum) continue;
    const double share = (sum - knots[i - 1].sum) / (knots[i].sum - knots[i - 1].sum);
    return knots[i - 1].p_right + share * (knots[i].p_right - knots[i - 1].p_right);
  }
  return knots[count - 1].p_right;
}

double p_right_limit(const Inconsistencies& doubts) {
  const bool is_decided = is_veto(ConsistencyTest::kMotion, doubts) ||
                          is_veto(ConsistencyTest::kFocalLength, doubts) ||
                          is_veto(ConsistencyTest::kNoCrossCheck, doubts);
  return is_decided ? kAtMostInDoubt : 1.0;
}

double p_right(const Inconsistencies& doubts) {
  return std::min(p_right_at(trust_table::kKnots.data(), trust_table::kKnots.size(), weighted_sum(doubts)),
                  p_right_limit(doubts));
}

// Until it is measured, that of the Kinect's rolling shutter against the truth; three values, soon outvoted.
MotionConfidence::MotionConfidence() {
  constexpr double kUsualTurnError = 0.07;  // median depths per radian
  for (int i = 0; i < 3; ++i) turn_errors_.add(kUsualTurnError);
}

FrameConfidence MotionConfidence::add(const ConfidenceInput& frame) {
  const FrameEvidence& e = frame.evidence;
  const MotionHistory::Newest& motion = frame.motion;
  if (std::exchange(segment_, frame.segment) != frame.segment) moved_.clear();
  blurs_.add(e.edge_blur), saturated_.add(e.saturated_share);
  weak_.add(decades_of(e.pose_sigmas.back()));
  if (e.residual_px > 0) residuals_.add(e.residual_px);
  starvation_.add(inconsistency_of_starvation(e));
  image_.add(inconsistency_of_image(e.edge_blur, blurs_.median(), e.saturated_share, saturated_.median()));

  FrameConfidence trust;
  const CornerEvidence corners = e.corners.value_or(CornerEvidence());
  const auto set = [&](ConsistencyTest doubt, double value) {
    trust.doubts[size_t(doubt)] = value > 0 ? value : 0;
  };
  turn_errors_.add(turn_error(corners, motion.turn_rad));
  set(ConsistencyTest::kMotion, inconsistency_of_corner_motion(corners));
  set(ConsistencyTest::kFocalLength,
      inconsistency_of_focal_length(e.focal_error, e.focal_error_sigma, deg(motion.turn_rad)));
  set(ConsistencyTest::kCornerAgreement, inconsistency_of_corner_agreement(corners));
  set(ConsistencyTest::kNoCrossCheck,
      inconsistency_without_cross_check(e.corners, std::pow(10, weak_.mean())));
  set(ConsistencyTest::kTurn,
      inconsistency_of_turn(motion.turn_rad, motion.length / e.median_depth, turn_errors_.median(1)));
  if (!e.stands)
    set(ConsistencyTest::kStep, inconsistency_of_step(motion.recent, motion.usual, e.median_depth));
  set(ConsistencyTest::kResidual, inconsistency_of_residual(residuals_.mean()));
  set(ConsistencyTest::kAdjustment, inconsistency_of_adjustment(moved_.mean()));
  set(ConsistencyTest::kStarvation, starvation_.mean());
  set(ConsistencyTest::kImage, image_.mean());
  trust.p_right = edgevo::p_right(trust.doubts);
  if (trust.p_right < kDoubtfulBelow) trust.reasons = {reason_of(largest_contribution(trust.doubts), e)};
  if (const double times = times_likely(motion.step, motion.usual, e.median_depth); times > kStepGate) {
    trust.p_right = std::min(trust.p_right, kAtMostInDoubt);
    trust.reasons = {{ReasonKind::kStep, times}};
  }
  const double times_usual = std::fmax(motion.step / motion.usual_before, frame.times_usual_live);
  trust.is_step_outlier = times_usual > kStepGate;
  if (trust.is_step_outlier && trust.reasons.empty()) trust.reasons = {{ReasonKind::kStep, times_usual}};
  return trust;
}

}  // namespace edgevo
