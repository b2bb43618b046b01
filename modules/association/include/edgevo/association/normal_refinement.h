// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One-dimensional Lucas-Kanade along an edge normal: moves a match along its normal until the warped
// intensity patch of the host, normalised to zero mean and unit standard deviation, fits best. This removes
// the bias of the nearest neighbour towards the prediction.
#include "edgevo/association/warp.h"

namespace edgevo {

/// Radius r of the refinement patches, pixels; their side is 2 r + 1.
constexpr int kRefinementRadius = 4;

/// Host patch prepared for refinement along one direction of the target image.
struct NormalTemplate {
  /// Normalised values: zero mean, unit standard deviation.
  Patch value;
  /// Derivative of `value` by a shift along the normal, without the component that the normalisation cancels.
  Patch slope;
  /// Sum of slope^2.
  double slope_square = 0;
};

/// Prepares a template; false if the patch leaves the image or is flat.
template <class T>
bool make_normal_template(const ImageView<T>& host, const Eigen::Vector2d& px_host,
                          const Eigen::Matrix2d& A_target_host, const Eigen::Vector2d& normal_target,
                          int radius, NormalTemplate* out);

/// Result of a refinement.
struct NormalRefinement {
  /// Whether the refinement succeeded; if not, the match stays unchanged.
  bool accepted = false;
  /// Refined position, start + move_px * normal.
  Eigen::Vector2d px;
  /// Signed shift along the normal, pixels.
  double move_px = 0;
  /// 1 - ZNCC at the refined position.
  double zncc_loss = 2;
};
/// Refines a match. Takes at most 12 steps and stops at 0.02 px; not accepted if it moves by more than 3 px
/// or the patch does not fit (ZNCC below 0.85).
template <class T>
NormalRefinement refine_along_normal(const NormalTemplate& patch, const ImageView<T>& target,
                                     const Eigen::Vector2d& start, const Eigen::Vector2d& normal);

}  // namespace edgevo
