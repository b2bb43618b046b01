// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/collect_evidence.h"

#include <algorithm>
#include <limits>

#include "edgevo/alignment/pose_covariance.h"
#include "edgevo/edges/image_quality.h"

namespace edgevo {
namespace {

void add_candidate(const PoseCandidate& pose, FrameEvidence* evidence) {
  evidence->diverged = !pose.T_cur_ref.is_finite();
  evidence->visible_points = pose.stats.visible;
  evidence->matched_points = pose.stats.inliers;
  evidence->inlier_share = pose.evidence.inlier_share;
  evidence->residual_px = pose.stats.residual_px;
}

void add_reference(const Reference& reference, FrameEvidence* evidence) {
  evidence->known_points = reference.known_points;
  evidence->view_share = reference.view_share;
  if (reference.wanted_points > 0)
    evidence->lacking_share = std::max(0.0, 1 - double(reference.known_points) / reference.wanted_points);
}

}  // namespace

FrameEvidence evidence_of(const PoseCandidate& pose) {
  FrameEvidence evidence;
  add_candidate(pose, &evidence);
  return evidence;
}

void add_image(const FramePyramid& pyramid, FrameEvidence* evidence) {
  evidence->edges = int(pyramid.finest().edges.pixels.size());
  evidence->saturated_share = saturated_share(pyramid);
  evidence->edge_blur = edge_blur(pyramid);
}

void add_pose(const TrackResult& pose, const Reference& reference, FrameEvidence* evidence) {
  add_candidate(pose, evidence);
  evidence->pose_sigmas = FrameEvidence::unknown_sigmas();
  if (!evidence->diverged) std::copy_n(pose.sigmas.data(), 6, evidence->pose_sigmas.begin());
  evidence->step_sigmas = std::numeric_limits<double>::quiet_NaN();
  add_reference(reference, evidence);
}

Matrix6d reported_covariance(const TrackResult& pose, const Reference& reference) {
  const Matrix6d smooth = kReferenceShare * pose.correlated_px2 * pose.smooth.covariance;
  return reference.error_factor * (pose.covariance + smooth) + unit_covariance(pose.T_cur_ref);
}

}  // namespace edgevo
