// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Semi-dense epipolar flow in the manner of FSDEF (Garrigues and Manzanera, "Fast semi dense epipolar flow
// estimation", 2017), reimplemented from the publication: flow at points of strong gradient, coarse to fine,
// spread from neighbour to neighbour; the epipolar geometry is estimated from it; then each point is searched
// along its epipolar line only.
//
// Patches are compared at zero mean and unit standard deviation, so that gain and offset of the light cancel.
// Known differences from the original: it compares other descriptors, and it works on a video, where the flow
// of the previous frame predicts the next.
#include <Eigen/Core>
#include <vector>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Parameters of epipolar_flow().
struct EpipolarFlowParams {
  /// Radius r of a patch of 2 r + 1 pixels a side.
  int patch_radius = 3;
  /// Search radius on the coarsest level, pixels of that level.
  int coarse_radius = 10;
  /// Number of edge pixels used to estimate the geometry and to spread the flow.
  int support_points = 1200;
  /// Inlier threshold of the distance from the epipolar line, pixels.
  double ransac_px = 1.0;
  /// Search radius along the epipolar line around each prediction, pixels.
  int line_radius = 4;
  /// ZNCC below which there is no match.
  double min_correlation = 0.8;
};

/// Flow of one point.
struct FlowMatch {
  /// True if the point was found; the other fields are valid only then.
  bool found = false;
  /// Position in the second image, pixels.
  Eigen::Vector2d px;
  /// ZNCC, -1 to 1.
  double correlation = -1;
};

/// Flow of `points` (pixels of `from`). Nothing is found without a geometry (fewer than 20 inliers).
/// Deterministic. Cost: about 150 ms for 800 points at 1241x376.
std::vector<FlowMatch> epipolar_flow(const FramePyramid& from, const FramePyramid& to,
                                     const std::vector<Eigen::Vector2d>& points,
                                     const EpipolarFlowParams& params = {});

}  // namespace edgevo
