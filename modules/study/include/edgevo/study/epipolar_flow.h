#pragma once
// Semi-dense epipolar flow in the manner of FSDEF (Garrigues and Manzanera, "Fast semi dense epipolar flow estimation", 2017),
// written from the idea: flow at points of strong gradient, coarse to fine, spread from neighbour to neighbour; the epipolar
// geometry is estimated from it; then each point is searched along its epipolar line only.
//
// Patches are compared at zero mean and unit deviation, so that gain and offset of the light cancel. Differences to the original
// that we know of: it compares other descriptors, and it works on a video, where the flow of the frame before predicts the next.
#include <Eigen/Core>
#include <vector>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Parameters of the flow.
struct EpipolarFlowParams {
  int patch_radius = 3;  ///< pixels; 2 r + 1 a side
  int coarse_radius = 10;        ///< search on the coarsest level, pixels there
  int support_points = 1200;     ///< edge pixels that help to find the geometry and to spread the flow
  double ransac_px = 1.0;        ///< distance from the epipolar line
  int line_radius = 4;           ///< search along the line about each prediction, pixels
  double min_correlation = 0.8;  ///< ZNCC below which there is no match
};

/// The flow of one point.
struct FlowMatch {
  bool found = false;  ///< all else holds only then
  Eigen::Vector2d px;  ///< in the second image
  double correlation = -1;  ///< ZNCC
};

/// Flow of `points` (pixels of `from`). Without a geometry (fewer than 20 inliers) nothing is found. Deterministic. Cost: about
/// 150 ms for 800 points at 1241x376.
std::vector<FlowMatch> epipolar_flow(const FramePyramid& from, const FramePyramid& to, const std::vector<Eigen::Vector2d>& points,
                                     const EpipolarFlowParams& params = {});

}  // namespace edgevo
