// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Comparison of patches along an edge: the paper uses intensity, census and gradient in its template matching
// (section V-A). The odometry uses gradient; the other two serve as references for `edgevo study`.
//
//   gradient    gradient magnitudes, each patch divided by its own mean (patch_cost.h); mean |a - b|
//   intensity   unnormalised gray levels: mean |a - b| in units of 80 gray levels, about the difference of
//               unrelated edges
//   census      signs of (pixel - centre) in the gray image (Zabih and Woodfill); twice the share of signs
//               that disagree
//
// All costs lie in [0, 2] on the same scale: 0 for equal patches, about 1 for unrelated ones. So one set of
// AssociationParams (max_cost, sigma_c) serves all three.
#include <Eigen/Core>

#include "edgevo/association/patch_cost.h"
#include "edgevo/association/warp.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Interface of a patch comparison; stateless.
class PatchComparison {
 public:
  virtual ~PatchComparison() = default;

  /// Cuts the host patch around px_host, warped into the target, and prepares it for comparison. False if it
  /// leaves the image or is flat.
  [[nodiscard]] virtual bool cut(const PyramidLevel& host, const Eigen::Vector2d& px_host,
                                 const Eigen::Matrix2d& A_target_host, int radius, Patch* patch) const = 0;
  /// Cost of a patch made by cut() against the target around (x, y); kWorstPatchCost if the target patch is
  /// too close to the border or flat.
  virtual double cost(const Patch& patch, const PyramidLevel& target, double x, double y) const = 0;
};

/// Comparison of gradient magnitudes. Thread-safe.
const PatchComparison& gradient_comparison();
/// Comparison of gray levels. Thread-safe.
const PatchComparison& intensity_comparison();
/// Comparison of census signs. Thread-safe.
const PatchComparison& census_comparison();

}  // namespace edgevo
