// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The points of the study: drawn uniformly from the edge pixels of a frame, with their exact inverse depth
// and a noisy one.
//
// The paper adds "white Gaussian noise with 1.0 standard variance to ground truth inverse depth". In 1/m that
// would be many times the inverse depth of anything in a street (0.02 to 0.3), so the unit cannot be that.
// Here the noise is relative: rho' = rho (1 + s n) with n standard normal, which moves every point's depth by
// the same share and thus its projection by s times its own flow. s is a parameter; 0.05 is about what the
// odometry's depth filter delivers (a projection known to 1.5 px at 30 px of flow).
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/random.h"
#include "edgevo/edges/image_edges.h"

namespace edgevo {

/// A point of the study.
struct StudyPoint {
  /// Position in the host image, pixels.
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  /// Unit gradient at the point.
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  /// Exact inverse depth, 1/m.
  double idepth_true = 0;
  /// Inverse depth with noise, 1/m, at least a tenth of the exact one.
  double idepth = 0;
  /// Standard deviation of the noise, 1/m.
  double idepth_sigma = 0;
};

/// At most `count` points without repetition, none in the sky. `noise` >= 0 is s above.
std::vector<StudyPoint> sample_points(const ImageEdges& edges, const ImageView<float>& depth, int count,
                                      double noise, Random* random);

}  // namespace edgevo
