// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/trust.h"

#include <algorithm>
#include <cmath>

#include "doubts.h"
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

double weighted_sum(const Doubts& doubts) {
  double sum = 0;
  for (const trust_table::Term& term : trust_table::kTerms) sum += term.weight * doubts[size_t(term.doubt)];
  return sum;
}

// The value of a doubt from which on it decides alone.
double decisive(Doubt doubt) {
  constexpr double kContradiction = 1.6;  // no right frame of the corpus on a camera that moves evenly
  switch (doubt) {
    case Doubt::kMotion:
      return kContradiction;
    case Doubt::kFocalLength:
      return 1;
    case Doubt::kNoWitness:
      return kMaxDoubt;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

bool decides_alone(Doubt doubt, const Doubts& doubts) { return doubts[size_t(doubt)] >= decisive(doubt); }

Doubt largest_contribution(const Doubts& doubts) {
  for (const Doubt doubt : {Doubt::kMotion, Doubt::kFocalLength, Doubt::kNoWitness})
    if (decides_alone(doubt, doubts)) return doubt;
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
  if (doubt_of_corner_scale(c) >= 1) return reason_by_scale(c);
  if (c.rotation_deg > kMotionTolerance.rotation_deg) return {ReasonKind::kRotationByCorners, c.rotation_deg};
  return {ReasonKind::kMotionByCorners, c.motion_error};
}

Reason reason_of(Doubt doubt, const FrameEvidence& e) {
  const CornerEvidence c = e.corners.value_or(CornerEvidence());
  switch (doubt) {
    case Doubt::kMotion:
      return reason_by_motion(c);
    case Doubt::kFocalLength:
      return {ReasonKind::kFocalLength, e.focal_error};
    case Doubt::kCornerAgreement:
      return {ReasonKind::kCornersContradict, 1 - c.agreeing_share};
    case Doubt::kNoWitness:
      return {ReasonKind::kFewCornersToCheck, double(c.tracks)};
    case Doubt::kTurn:
      return {ReasonKind::kTurn};
    case Doubt::kStep:
      return {ReasonKind::kSteps};
    case Doubt::kResidual:
      return {ReasonKind::kResidual, e.residual_px};
    case Doubt::kAdjustment:
      return {ReasonKind::kAdjustment};
    case Doubt::kStarvation:
      return {ReasonKind::kStarvation, double(e.known_points.value_or(0)), e.inlier_share};
    case Doubt::kImage:
      break;
  }
  return {ReasonKind::kImage};
}

}  // namespace

double p_right_at(const TrustKnot* knots, size_t count, double sum) {
  if (sum <= knots[0].sum) return knots[0].p_right;
  for (size_t i = 1; i < count; ++i) {
    if (sum > knots[i].sum) continue;
    const double share = (sum - knots[i - 1].sum) / (knots[i].sum - knots[i - 1].sum);
    return knots[i - 1].p_right + share * (knots[i].p_right - knots[i - 1].p_right);
  }
  return knots[count - 1].p_right;
}

double p_right_limit(const Doubts& doubts) {
  const bool is_decided = decides_alone(Doubt::kMotion, doubts) ||
                          decides_alone(Doubt::kFocalLength, doubts) ||
                          decides_alone(Doubt::kNoWitness, doubts);
  return is_decided ? kAtMostInDoubt : 1.0;
}

double p_right(const Doubts& doubts) {
  return std::min(p_right_at(trust_table::kKnots.data(), trust_table::kKnots.size(), weighted_sum(doubts)),
                  p_right_limit(doubts));
}

// Until it is measured, that of the Kinect's rolling shutter against the truth; three values, soon outvoted.
Trust::Trust() {
  constexpr double kUsualTurnError = 0.07;  // median depths per radian
  for (int i = 0; i < 3; ++i) turn_errors_.add(kUsualTurnError);
}

void Trust::begin_segment(int segment) {
  segment_ = segment;
  interrupt();
  steps_.clear();  // in another unit
  moved_.clear();
}

// NaN at the beginning of a segment, and over a gap.
double Trust::step_of(const TrustFrame& frame) {
  if (frame.segment != segment_) begin_segment(frame.segment);
  const double step = last_centre_ ? (frame.T_map_cam.translation() - *last_centre_).norm()
                                   : std::numeric_limits<double>::quiet_NaN();
  last_centre_ = frame.T_map_cam.translation();
  return step;
}

Trust::Motion Trust::motion_of(const TrustFrame& frame) {
  poses_.push_back(frame.T_map_cam);
  if (poses_.size() > kFrames + 1) poses_.pop_front();
  const SE3 &from = poses_.front(), &to = poses_.back();
  return {from.rotation().angularDistance(to.rotation()), (to.translation() - from.translation()).norm()};
}

FrameTrust Trust::add(const TrustFrame& frame) {
  constexpr size_t kRecentSteps = 5;
  const FrameEvidence& e = frame.evidence;
  // The smaller of the middle two: a camera that stands and moves by turns has two groups of steps, and the
  // larger ones are not usual as long as half of all are small.
  const double step = step_of(frame), usual_step = steps_.quantile(0.5);
  if (!e.stands) steps_.add(step);
  blurs_.add(e.edge_blur), saturated_.add(e.saturated_share);
  weak_.add(decades_of(e.pose_sigmas.back()));
  if (e.residual_px > 0) residuals_.add(e.residual_px);
  starvation_.add(doubt_of_starvation(e));
  image_.add(doubt_of_image(e.edge_blur, blurs_.median(), e.saturated_share, saturated_.median()));

  FrameTrust trust;
  const CornerEvidence corners = e.corners.value_or(CornerEvidence());
  const auto set = [&](Doubt doubt, double value) { trust.doubts[size_t(doubt)] = value > 0 ? value : 0; };
  const Motion motion = motion_of(frame);
  turn_errors_.add(turn_error(corners, motion.turn_rad));
  set(Doubt::kMotion, doubt_of_corner_motion(corners));
  set(Doubt::kFocalLength, doubt_of_focal_length(e.focal_error, e.focal_error_sigma, motion.turn_deg()));
  set(Doubt::kCornerAgreement, doubt_of_corner_agreement(corners));
  set(Doubt::kNoWitness, doubt_without_witness(e.corners, std::pow(10, weak_.mean())));
  set(Doubt::kTurn, doubt_of_turn(motion.turn_rad, motion.length / e.median_depth, turn_errors_.median(1)));
  if (!e.stands) set(Doubt::kStep, doubt_of_step(steps_.mean(kRecentSteps), steps_.median(), e.median_depth));
  set(Doubt::kResidual, doubt_of_residual(residuals_.mean()));
  set(Doubt::kAdjustment, doubt_of_adjustment(moved_.mean()));
  set(Doubt::kStarvation, starvation_.mean());
  set(Doubt::kImage, image_.mean());
  trust.p_right = edgevo::p_right(trust.doubts);
  if (trust.p_right < kDoubtfulBelow) trust.reasons = {reason_of(largest_contribution(trust.doubts), e)};
  if (const double times = times_likely(step, steps_.median(), e.median_depth); times > kGiantTimes) {
    trust.p_right = std::min(trust.p_right, kAtMostInDoubt);
    trust.reasons = {{ReasonKind::kStep, times}};
  }
  const double times_usual = std::fmax(step / usual_step, frame.times_usual_live);
  trust.is_giant_step = times_usual > kGiantTimes;
  if (trust.is_giant_step && trust.reasons.empty()) trust.reasons = {{ReasonKind::kStep, times_usual}};
  return trust;
}

}  // namespace edgevo
