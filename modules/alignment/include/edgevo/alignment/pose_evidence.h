#pragma once
// What the map points say about a pose: how many can testify, and which share of them does.
//
// A point whose uncertain depth lets it lie anywhere on some pixels cannot contradict a pose, so each one
// weighs w = 1 / (1 + s^2), with s the deviation of its projection along the edge normal in pixels. Those
// that find an edge of the same direction within the robust width (huber_px) of where the pose puts them
// speak for it. At a wrong pose nearly as few do as by chance, whatever the light: a count of edge matches
// within the wider gates of the alignment, by contrast, still finds half of them in foliage
// (share/lab/archive/2026-11-22_tracking_verdict.md has the figures).
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/alignment/pose_covariance.h"
#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// The support of the image for a pose.
struct PoseEvidence {
  double weight = 0;        ///< sum of w over the points in view
  double inlier_share = 0;  ///< of that weight, what speaks for the pose, [0, 1]
};

/// On the finest level. Cost: one pass over the cloud, about 0.1 ms for 1500 points.
PoseEvidence weigh_evidence(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                            const AlignmentParams& params);

/// What speaks for a pose beyond what a wrong one has by chance, to choose among poses. A wrong pose that
/// keeps more points in view finds more edges than the right one, but not a larger share of them. Negative
/// below the limit of LOST.
inline double support(const PoseEvidence& evidence, const AlignmentParams& params) {
  return (evidence.inlier_share - params.lost_share) * evidence.weight;
}

/// The equations of Eq. (edgeerror) at a pose, for pose_covariance(). Cost: as above.
std::vector<PoseEquation> pose_equations(const FramePyramid& current, const ReferenceCloud& cloud,
                                         const SE3& T_cur_ref, const AlignmentParams& params);

}  // namespace edgevo
