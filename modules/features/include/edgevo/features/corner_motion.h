// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A motion hypothesis from corner matches, for a frame that the edges of the map explain poorly.
//
// In a fast turn the map leaves the view before its depths have converged. Poses and depths then go wrong
// together, and the edges still fit: an edge gives one equation, which its own depth absorbs. A corner is
// matched forwards and backwards without any map. The corners alone give the rotation and the direction of
// the translation; its length comes from the edges.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/random.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/features/corner_params.h"
#include "edgevo/map/keyframe.h"

namespace edgevo {

/// Camera motion estimated from corners.
struct CornerMotion {
  /// Motion between the two cameras, |translation| = 1.
  SE3 T_to_from;
  /// Inliers of the motion.
  std::vector<CornerPair> pairs;
};

/// Tracks corners of `from` into `to`, starting where the rotation of `T_to_from` predicts them (wrong by
/// some degrees at most), and estimates an essential matrix by RANSAC, refined over all inliers. Returns
/// nothing if there are too few inliers, or too little parallax: the direction is not known then.
/// Deterministic for a seed. Cost: some 30 ms at 1241x376 with 450 corners.
std::optional<CornerMotion> find_corner_motion(const Pinhole& pinhole, const FramePyramid& from,
                                               const FramePyramid& to, const SE3& T_to_from,
                                               const CornerParams& params, Random* random);

}  // namespace edgevo
