#pragma once
// The direct image-gradient cost of one point, paper Eq. (photometricerror) with F the gradient magnitude, linearised: near the
// projection p' the patch difference is least at p' + shift, and grows with `information` around it. Adding the residual
//     shift-corrected position minus projection, weighed by information,
// to a bundle adjustment is one Gauss-Newton linearisation of the direct cost; it is renewed at each round of the adjustment.
#include <Eigen/Core>

#include "edgevo/association/warp.h"

namespace edgevo {

/// The linearised cost of one point in one keyframe.
struct PhotometricResidual {
  bool usable = false;            ///< patch inside both images, not flat, shift within the linear range
  Eigen::Vector2d shift;          ///< pixels; the Gauss-Newton step of the patch cost from p'
  Eigen::Matrix2d information;    ///< mean over the patch of grad grad^T, patches at zero mean and unit deviation; 1/px^2
  double mean_square = 0;         ///< of the difference at p', in deviations
};

/// `host` and `target` are gradient magnitudes. Patch of 5x5, warped by A_target_host. Cost: about 0.4 us.
PhotometricResidual photometric_residual(const ImageView<float>& host, const Eigen::Vector2d& px_host,
                                         const Eigen::Matrix2d& A_target_host, const ImageView<float>& target,
                                         const Eigen::Vector2d& px_target);

}  // namespace edgevo
