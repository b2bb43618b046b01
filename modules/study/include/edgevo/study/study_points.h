#pragma once
// The points of the study: drawn uniformly from the edge pixels of a frame, with their exact inverse depth
// and a noisy one.
//
// The paper adds "white Gaussian noise with 1.0 standard variance to ground truth inverse depth". In 1/m that
// would be many times the inverse depth of anything in a street (0.02 to 0.3), so the unit cannot be that.
// Here the noise is relative: rho' = rho (1
// + s n) with n standard normal, which moves every point's depth by the same share and thus its projection by
// s times its own flow. s is a parameter; 0.05 is about what the odometry's depth filter hands over (a
// projection known to 1.5 px at 30 px of flow).
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/random.h"
#include "edgevo/edges/edge_map.h"

namespace edgevo {

/// A point of the study.
struct StudyPoint {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();       ///< in the host image
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit gradient there
  double idepth_true = 0;                             ///< 1/m
  double idepth = 0;                                  ///< with noise, at least a tenth of the truth
  double idepth_sigma = 0;                            ///< standard deviation of the noise
};

/// At most `count` points without repetition, the sky left out. `noise` >= 0 is s above.
std::vector<StudyPoint> sample_points(const EdgeMap& edges, const ImageView<float>& depth, int count,
                                      double noise, Random* random);

}  // namespace edgevo
