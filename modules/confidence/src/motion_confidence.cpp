// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/motion_confidence.h"

#include <algorithm>
#include <cmath>

#include "consistency_tests.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/doubtful_frame.h"
#include "trust_table.h"

namespace edgevo {
namespace {

static_assert(trust_table::kDoubtfulBelow == kDoubtfulBelow, "copy it to core/doubtful_frame.h");

// Decimal logarithm of a standard deviation of the pose; an unknown one is not a small one.
double decades_of(double pose_sigma) { return std::isfinite(pose_sigma) ? std::log10(pose_sigma) : 0.0; }

// What a test adds to the log odds of a wrong motion.
double contribution(const trust_table::Term& term, const Inconsistencies& doubts) {
  return term.weight * (doubts[size_t(term.doubt)] - term.usual);
}

double log_odds_of_wrong(const Inconsistencies& doubts) {
  double sum = trust_table::kBias;
  for (const trust_table::Term& term : trust_table::kTerms) sum += contribution(term, doubts);
  return sum;
}

ConsistencyTest largest_contribution(const Inconsistencies& doubts) {
  return std::max_element(
             trust_table::kTerms.begin(), trust_table::kTerms.end(),
             [&](const auto& a, const auto& b) { return contribution(a, doubts) < contribution(b, doubts); })
      ->doubt;
}

// What corners contradict beyond its tolerance: the rotation, the length, else the direction.
Reason reason_of(const CornerEvidence& c) {
  if (c.rotation_deg > kMotionTolerance.rotation_deg || std::isnan(c.motion_error))
    return {ReasonKind::kRotationByCorners, c.rotation_deg};
  if (std::abs(std::expm1(-c.change_10)) > kMotionTolerance.share_of_length)
    return {ReasonKind::kScaleByCorners, std::exp(-c.change_10), 10.0};
  return {ReasonKind::kTranslationByCorners, c.motion_error};
}

Reason reason_of(ConsistencyTest doubt, const FrameEvidence& e) {
  switch (doubt) {
    case ConsistencyTest::kCorners:
      return reason_of(e.corners.value_or(CornerEvidence()));
    case ConsistencyTest::kTurn:
      return {ReasonKind::kTurn};
    case ConsistencyTest::kStep:
      return {ReasonKind::kSteps};
    case ConsistencyTest::kResidual:
      return {ReasonKind::kResidual, e.residual_px};
    case ConsistencyTest::kInformation:
      return {ReasonKind::kLittleInformation, e.pose_sigmas.back()};
    case ConsistencyTest::kMap:
      break;
  }
  return {ReasonKind::kMapMoved, e.moved_by_map};
}

Reason reason_for_doubt(const FrameConfidence& trust, const ConfidenceInput& frame) {
  const FrameEvidence& e = frame.evidence;
  if (p_right(trust.doubts) < kDoubtfulBelow) return reason_of(largest_contribution(trust.doubts), e);
  if (trust.p_wrong_zoom > std::max(trust.p_wrong_unit, trust.p_wrong_focal_length))
    return {ReasonKind::kZoom, std::abs(frame.by_zoom.zoom)};
  if (trust.p_wrong_unit > trust.p_wrong_focal_length) return {ReasonKind::kUnitCarried, trust.unit_sigma};
  return {ReasonKind::kFocalLength, e.focal_error};
}

}  // namespace

double p_right(const Inconsistencies& doubts, double p_wrong_otherwise) {
  return (1 - p_wrong_otherwise) / (1 + std::exp(log_odds_of_wrong(doubts)));
}

// A long step counts at once, steps that differ from what is usual as long as the motion.
double MotionConfidence::unusual_steps(double change) {
  squared_changes_.add(change * change);
  return std::max(std::sqrt(squared_changes_.mean()), change);
}

double MotionConfidence::carried_unit_sigma() {
  unit_variances_.add(std::exchange(new_variance_, 0));
  return std::sqrt(unit_variances_.mean() * double(unit_variances_.size()));
}

FrameConfidence MotionConfidence::add(const ConfidenceInput& frame) {
  const FrameEvidence& e = frame.evidence;
  const MotionHistory::Newest& motion = frame.motion;
  decades_.add(decades_of(e.pose_sigmas.back()));
  if (e.residual_px > 0) residuals_.add(e.residual_px);

  FrameConfidence trust;
  const auto set = [&](ConsistencyTest doubt, double value) {
    trust.doubts[size_t(doubt)] = std::isfinite(value) ? value : trust_table::kTerms[size_t(doubt)].usual;
  };
  const double length = motion.length / e.median_depth,
               change = e.stands ? 0.0 : change_of_step(motion.step, motion.usual, e.median_depth);
  set(ConsistencyTest::kCorners, evidence_of_corners(e.corners.value_or(CornerEvidence()), length));
  set(ConsistencyTest::kTurn, evidence_of_turn(motion.turn_rad, length, params_.turn_error));
  set(ConsistencyTest::kStep, unusual_steps(change));
  set(ConsistencyTest::kResidual, std::log(residuals_.mean()));
  set(ConsistencyTest::kInformation, decades_.mean());
  if (const double moved = evidence_of_map(e.moved_by_map, length); std::isfinite(moved)) moved_.add(moved);
  set(ConsistencyTest::kMap, moved_.quantile(1, 1));
  trust.p_wrong_focal_length =
      probability_of_wrong_focal_length(e.focal_error, e.focal_error_sigma, deg(motion.turn_rad));
  trust.unit_sigma = carried_unit_sigma();
  trust.p_wrong_unit = probability_beyond(0, trust.unit_sigma, kMotionTolerance.share_of_length);
  trust.p_wrong_zoom = probability_of_wrong_zoom(frame.by_zoom.depths, frame.by_zoom.sigma, length);
  trust.p_right = edgevo::p_right(trust.doubts, 1 - (1 - trust.p_wrong_focal_length) *
                                                        (1 - trust.p_wrong_unit) * (1 - trust.p_wrong_zoom));
  if (trust.p_right < kDoubtfulBelow) trust.reasons = {reason_for_doubt(trust, frame)};
  return trust;
}

}  // namespace edgevo
