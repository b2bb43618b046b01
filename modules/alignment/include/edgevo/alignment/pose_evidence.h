// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Support of a pose by the map points: how many can support it, and which share of them does.
//
// A point that may project anywhere within several pixels because of its uncertain depth cannot contradict a
// pose. So each point has the weight w = 1 / (1 + s^2), with s the standard deviation of its projection along
// the edge normal in pixels. A point is an inlier if an edge of like direction lies within the robust width
// (huber_px) of its projection. At a wrong pose there are hardly more inliers than by chance, whatever the
// light; by contrast, half the points still have an edge match within the wider gates of the alignment in
// foliage (figures: lab 2026-11-22_tracking_verdict).
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/alignment/pose_covariance.h"
#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Support of a pose by the image.
struct PoseEvidence {
  /// Sum of the weights w of the points in view.
  double weight = 0;
  /// Share of that weight that belongs to inliers, 0 to 1.
  double inlier_share = 0;
};

/// Evidence for a pose on the finest level. Cost: about 0.1 ms for 1500 points.
PoseEvidence weigh_evidence(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                            const AlignmentParams& params);

/// Equations of Eq. (edgeerror) at a pose, for pose_covariance(). Cost: about 0.1 ms for 1500 points.
std::vector<PoseEquation> pose_equations(const FramePyramid& current, const ReferenceCloud& cloud,
                                         const SE3& T_cur_ref, const AlignmentParams& params);

}  // namespace edgevo
