#pragma once
// One-dimensional Lucas-Kanade along an edge normal: moves a match along its normal until the warped host
// patch of intensity, at zero mean and unit deviation, fits best. Removes the pull of the nearest neighbour
// towards the prediction.
#include "edgevo/association/warp.h"

namespace edgevo {

/// The patches of a refinement have 2 r + 1 pixels a side.
constexpr int kRefinementRadius = 4;

/// A host patch ready for refinement along one direction of the target image.
struct NormalTemplate {
  Patch value;              ///< zero mean, unit deviation
  Patch slope;              ///< d value / d shift along the normal, the normalisation's share taken out
  double slope_square = 0;  ///< sum of slope^2
};

/// False where the patch leaves the image or is flat.
bool make_normal_template(const ImageView<uint8_t>& host, const Eigen::Vector2d& px_host,
                          const Eigen::Matrix2d& A_target_host, const Eigen::Vector2d& normal_target,
                          int radius, NormalTemplate* out);

/// Where a refinement ended.
struct NormalRefinement {
  bool accepted = false;  ///< false: keep the match as it was
  Eigen::Vector2d px;     ///< start + move * normal
  double move_px = 0;     ///< along the normal, signed
  double zncc_loss = 2;   ///< 1 - ZNCC at the end
};
/// At most 12 steps, stops at 0.02 px; not accepted where it moves over 3 px or the patch does not fit (ZNCC
/// below 0.85).
NormalRefinement refine_along_normal(const NormalTemplate& patch, const ImageView<uint8_t>& target,
                                     const Eigen::Vector2d& start, const Eigen::Vector2d& normal);

}  // namespace edgevo
