// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The focal length that corners show (focal_by_corners.h): when it is applied, and the map seen with it.
#include <optional>

#include "camera_problem.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// The correction of the focal length (ImageCorrection::focal) that is to be tried in place of the one in
/// use; nothing: that one stays. One is tried first where corners put it two thirds of `significance`
/// standard deviations off the file; later where it is off the one in use by a standard deviation; and the
/// file's is again where it is right to 1.5 after all. One that the map spoke against waits for another
/// window, and one at the limit (kMaxFocalError) is not tried.
std::optional<double> focal_length_to_try(const CameraRefinement& known, double significance);

/// Whether a focal length is applied with which the cost of the map is `cost_ratio` times that with the one
/// in use: where it is `significance` standard deviations off that one, unless the cost is much higher, since
/// matches were found with the one in use; where it is less far off, if the cost is lower.
bool is_supported_by_map(const CameraRefinement& known, double cost_ratio, double significance);

/// `problem` as cameras of the focal lengths `before` and, returned, `now` (ImageCorrection::focal) see it,
/// to first order: where an adjustment with `now` starts. Depths stay.
CameraProblem seen_with_focal_length(CameraProblem problem, double before, double now);

}  // namespace edgevo
