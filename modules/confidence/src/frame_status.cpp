// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/frame_status.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "consistency_tests.h"
#include "edgevo/confidence/collect_evidence.h"
#include "edgevo/core/doubtful_frame.h"

namespace edgevo {
namespace {

// Of the points in view, those that a map that is out of view must match to explain a frame: it has few left,
// and of these a wrong pose matches half.
constexpr double kExplainedShare = 0.7;

// Why a frame whose pose has this support has no pose or a weak one; empty where it is good.
Reasons reasons_of(PoseSupport support, const FrameEvidence& evidence, const StatusParams& params) {
  switch (support) {
    case PoseSupport::kDiverged:
      return {{ReasonKind::kDiverged}};
    case PoseSupport::kFewPoints:
      return {{ReasonKind::kFewPointsInView, double(evidence.visible_points.value_or(0)),
               double(params.min_visible)}};
    case PoseSupport::kUnsupported:
      return {{ReasonKind::kInlierShare, evidence.inlier_share, params.lost_share}};
    case PoseSupport::kWeak:
      return {{ReasonKind::kInlierShare, evidence.inlier_share, params.degraded_share}};
    case PoseSupport::kGood:
      break;
  }
  return {};
}

TrackingState state_of(PoseSupport support) {
  if (is_lost(support)) return TrackingState::kLost;
  return support == PoseSupport::kGood ? TrackingState::kTracking : TrackingState::kDegraded;
}

// Support of a pose in excess of what a wrong one has by chance, to select among poses. A wrong pose that
// keeps more points in view has more inliers than the right one, but not a larger share of them. Negative
// below the limit of LOST.
double excess_support(const PoseEvidence& evidence, const StatusParams& params) {
  return (evidence.inlier_share - params.lost_share) * evidence.weight;
}

}  // namespace

void StatusParams::visit(ParamVisitor& v) {
  v.number(kAdvanced, "degraded_share", degraded_share, 0, 1,
           "share of the weighted points below which a frame is DEGRADED");
  v.number(kBasic, "lost_share", lost_share, 0, 1,
           "share of the weighted points below which a frame is LOST");
  v.integer(
      kAdvanced, "min_visible", min_visible, 6, 10000,
      "with fewer points in view a frame is LOST; with fewer edge pixels an image shows nothing to follow");
  v.number(
      kExperimental, "away_view_share", away_view_share, 0, 1,
      "share of the window's points in view below which a map is out of view: a pure rotation leaves 3 %, "
      "bad light 40 % and more");
}

PoseSupport classify(const FrameEvidence& evidence, const StatusParams& params) {
  if (evidence.diverged) return PoseSupport::kDiverged;
  if (evidence.visible_points.value_or(0) < params.min_visible) return PoseSupport::kFewPoints;
  if (evidence.inlier_share < params.lost_share) return PoseSupport::kUnsupported;
  if (evidence.inlier_share < params.degraded_share) return PoseSupport::kWeak;
  return PoseSupport::kGood;
}

FrameStatus frame_status(const FrameEvidence& evidence, const StatusParams& params) {
  const PoseSupport support = classify(evidence, params);
  return {state_of(support), reasons_of(support, evidence, params)};
}

FrameStatus status_at_zero_velocity(const FrameEvidence& evidence, StatusParams params) {
  params.min_visible = 0;
  return frame_status(evidence, params);
}

FrameStatus frame_status(const FrameStatus& by_image, const FrameConfidence& trust) {
  const bool is_sure = !(trust.p_right < kDoubtfulBelow);
  if (by_image.state == TrackingState::kLost || is_sure) return by_image;
  return {TrackingState::kDegraded, joined(by_image.reasons, trust.reasons)};
}

FrameStatus status_with_refusal(const FrameStatus& by_image, const std::optional<Reason>& reason) {
  if (!reason || by_image.state == TrackingState::kLost) return by_image;
  return {TrackingState::kLost, {*reason}};
}

FrameStatus status_of_bootstrap_frame(const std::optional<FrameStatus>& by_image) {
  const bool is_explained = !by_image || by_image->state == TrackingState::kTracking;
  return {is_explained ? TrackingState::kTracking : TrackingState::kDegraded, {}};
}

void assign_status(FrameStatus status, FrameRecord* record) {
  record->state = status.state;
  record->note = to_string(status.reasons);
  record->reasons = std::move(status.reasons);
}

void assign_skipped(TrackingState state, std::string note, FrameRecord* record) {
  record->state = state;
  record->note = std::move(note);
  record->reasons = {{ReasonKind::kSkipped}};
}

double covariance_factor(double p_right) {
  return std::isnan(p_right) ? 1 : 1 / std::max(p_right, kMostCertain);
}

StatusParams with_counts(StatusParams params, const std::function<int(int)>& count) {
  params.min_visible = count(params.min_visible);
  return params;
}

bool shows_edges(int edges, const StatusParams& params) { return edges >= params.min_visible; }

bool is_out_of_view(const FrameEvidence& evidence, const StatusParams& params) {
  return evidence.view_share < params.away_view_share;
}

bool is_explained(const FrameEvidence& evidence) {
  const int visible = evidence.visible_points.value_or(0), matched = evidence.matched_points.value_or(0);
  return visible > 0 && matched >= kExplainedShare * visible;
}

bool SupportScorer::fits(const PoseCandidate& pose) const {
  return classify(evidence_of(pose), params_) == PoseSupport::kGood;
}

bool SupportScorer::is_lost(const PoseCandidate& pose) const {
  return edgevo::is_lost(classify(evidence_of(pose), params_));
}

double SupportScorer::score(const PoseCandidate& pose) const {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  if (!pose.T_cur_ref.is_finite()) return kNever;
  const double likelihood = likelihood_ ? likelihood_(pose.T_cur_ref) : 1.0;
  if (pose.has_prior && likelihood < 1) return kNever;
  const double by_image = excess_support(pose.evidence, params_);
  return by_image > 0 ? likelihood * by_image : by_image;
}

}  // namespace edgevo
