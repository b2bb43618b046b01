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

static_assert(trust_table::kDoubtfulBelow == kDoubtfulBelow, "copy it to core/doubtful_frame.h");

// A step over the usual one, or over what is a small one for a camera that has stood still.
double times_likely(double step, double usual, double median_depth, double small_step) {
  const double small = std::isfinite(median_depth) ? small_step * median_depth : 0.0;
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
double decisive(ConsistencyTest doubt, const VetoParams& veto) {
  switch (doubt) {
    case ConsistencyTest::kMotion:
      return veto.motion;
    case ConsistencyTest::kFocalLength:
      return veto.focal_length;
    case ConsistencyTest::kNoCrossCheck:
      return kMaxInconsistency;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

bool is_veto(ConsistencyTest doubt, const Inconsistencies& doubts, const VetoParams& veto) {
  return doubts[size_t(doubt)] >= decisive(doubt, veto);
}

ConsistencyTest largest_contribution(const Inconsistencies& doubts, const VetoParams& veto) {
  for (const ConsistencyTest doubt :
       {ConsistencyTest::kMotion, ConsistencyTest::kFocalLength, ConsistencyTest::kNoCrossCheck})
    if (is_veto(doubt, doubts, veto)) return doubt;
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

double p_right_limit(const Inconsistencies& doubts, const VetoParams& veto) {
  const bool is_decided = is_veto(ConsistencyTest::kMotion, doubts, veto) ||
                          is_veto(ConsistencyTest::kFocalLength, doubts, veto) ||
                          is_veto(ConsistencyTest::kNoCrossCheck, doubts, veto);
  return is_decided ? veto.p_right : 1.0;
}

double p_right(const Inconsistencies& doubts, const VetoParams& veto) {
  return std::min(p_right_at(trust_table::kKnots.data(), trust_table::kKnots.size(), weighted_sum(doubts)),
                  p_right_limit(doubts, veto));
}

// The turn error until it is measured: three values, soon outvoted.
MotionConfidence::MotionConfidence(const ConfidenceParams& params) : params_(params) {
  for (int i = 0; i < 3; ++i) turn_errors_.add(params.consistency.first_turn_error);
}

FrameConfidence MotionConfidence::add(const ConfidenceInput& frame) {
  const FrameEvidence& e = frame.evidence;
  const MotionHistory::Newest& motion = frame.motion;
  const ConsistencyParams& tests = params_.consistency;
  if (std::exchange(segment_, frame.segment) != frame.segment) moved_.clear();
  blurs_.add(e.edge_blur), saturated_.add(e.saturated_share);
  weak_.add(decades_of(e.pose_sigmas.back()));
  if (e.residual_px > 0) residuals_.add(e.residual_px);
  starvation_.add(inconsistency_of_starvation(e, tests));
  image_.add(
      inconsistency_of_image(e.edge_blur, blurs_.median(), e.saturated_share, saturated_.median(), tests));

  FrameConfidence trust;
  const CornerEvidence corners = e.corners.value_or(CornerEvidence());
  const auto set = [&](ConsistencyTest doubt, double value) {
    trust.doubts[size_t(doubt)] = value > 0 ? value : 0;
  };
  turn_errors_.add(turn_error(corners, motion.turn_rad, tests));
  set(ConsistencyTest::kMotion, inconsistency_of_corner_motion(corners, tests));
  set(ConsistencyTest::kFocalLength,
      inconsistency_of_focal_length(e.focal_error, e.focal_error_sigma, deg(motion.turn_rad), tests));
  set(ConsistencyTest::kCornerAgreement, inconsistency_of_corner_agreement(corners));
  set(ConsistencyTest::kNoCrossCheck,
      inconsistency_without_cross_check(e.corners, std::pow(10, weak_.mean()), tests));
  set(ConsistencyTest::kTurn,
      inconsistency_of_turn(motion.turn_rad, motion.length / e.median_depth, turn_errors_.median(1)));
  if (!e.stands)
    set(ConsistencyTest::kStep,
        inconsistency_of_step(motion.recent, motion.usual, e.median_depth, params_.step.small, tests));
  set(ConsistencyTest::kResidual, inconsistency_of_residual(residuals_.mean(), tests));
  set(ConsistencyTest::kAdjustment, inconsistency_of_adjustment(moved_.mean(), tests));
  set(ConsistencyTest::kStarvation, starvation_.mean());
  set(ConsistencyTest::kImage, image_.mean());
  trust.p_right = edgevo::p_right(trust.doubts, params_.veto);
  if (trust.p_right < kDoubtfulBelow)
    trust.reasons = {reason_of(largest_contribution(trust.doubts, params_.veto), e)};
  if (const double times = times_likely(motion.step, motion.usual, e.median_depth, params_.step.small);
      times > params_.step.times) {
    trust.p_right = std::min(trust.p_right, params_.veto.p_right);
    trust.reasons = {{ReasonKind::kStep, times}};
  }
  const double times_usual = std::fmax(motion.step / motion.usual_before, frame.times_usual_live);
  trust.is_step_outlier = times_usual > params_.step.times;
  if (trust.is_step_outlier && trust.reasons.empty()) trust.reasons = {{ReasonKind::kStep, times_usual}};
  return trust;
}

}  // namespace edgevo
