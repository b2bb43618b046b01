#pragma once
// How two patches are compared along an edge: the paper plugs intensity, census and gradient into its template matching (section
// V-A). The odometry uses gradient; the other two are there to be compared with (`edgevo study`).
//
//   gradient    gradient magnitudes, each patch divided by its own mean (patch_cost.h); mean |a - b|
//   intensity   gray levels as they are: mean |a - b| in units of 80 gray levels, about what unrelated edges differ by
//   census      signs of (pixel - centre) in the gray image (Zabih and Woodfill); twice the share that disagrees
//
// All costs lie in [0, 2] and are scaled alike: 0 is equal, unrelated patches cost about 1, so that one set of AssociationParams
// (max_cost, sigma_c) serves all three.
#include <Eigen/Core>

#include "edgevo/association/patch_cost.h"
#include "edgevo/association/warp.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// A way to compare patches; stateless.
class PatchComparison {
 public:
  virtual ~PatchComparison() = default;

  /// The host patch around px_host as the target will see it, ready to be compared. False where it leaves the image or is flat.
  [[nodiscard]] virtual bool cut(const PyramidLevel& host, const Eigen::Vector2d& px_host, const Eigen::Matrix2d& A_target_host,
                                 int radius, Patch* patch) const = 0;
  /// Cost of a patch made by cut() against the target around (x, y); kWorstPatchCost where that is too close to the border or
  /// flat.
  virtual double cost(const Patch& patch, const PyramidLevel& target, double x, double y) const = 0;
};

/// The three kinds; they hold no state and may be used from any thread.
const PatchComparison& gradient_comparison();
const PatchComparison& intensity_comparison();  ///< gray levels
const PatchComparison& census_comparison();  ///< census signs

}  // namespace edgevo
