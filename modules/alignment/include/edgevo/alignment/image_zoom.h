// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether an image is larger or smaller than pose and map explain: focus that hunts, a zoom, a stabiliser
// that crops. A step ahead enlarges what is near by more than what is far, a lens enlarges all alike; where
// depths differ the residuals show which it was, and where they do not the standard deviation says so.
#include <limits>
#include <vector>

#include "edgevo/alignment/pose_covariance.h"

namespace edgevo {

/// Enlargement of an image about its middle, beyond what its pose explains.
struct ImageZoom {
  /// As a share of the size; 0: none. And its standard deviation, with edges as clusters; NaN: unknown.
  double share = std::numeric_limits<double>::quiet_NaN(), sigma = std::numeric_limits<double>::quiet_NaN();
  /// Translation of the pose that such an enlargement feigns, in median depths per share: about 1.
  double feigned_depths = 0;
};

/// The enlargement that the residuals show at the pose that was found. `half_width_px`: of the image;
/// `depth`: its median. Cost: 0.03 ms for 1000 equations.
ImageZoom image_zoom(const std::vector<PoseEquation>& equations, double half_width_px, double depth);

}  // namespace edgevo
