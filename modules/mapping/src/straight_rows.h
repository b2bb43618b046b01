// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Corners of images that a rolling shutter has read, moved to where they are at the time of the middle row.
// Before there is a map, the corners themselves are all that is known of the motion of the image: the
// rotation that moves them best, which takes in most of a sideways translation, too.
#include <vector>

#include "edgevo/core/rectification.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/edges/image_motion.h"
#include "edgevo/features/corner_tracking.h"

namespace edgevo {

/// Motion of the image in each of two views or more, from the same corners in all of them, pixels of
/// `pinhole`. A camera that turns at a changing rate is followed: a view takes the mean of the rates before
/// and after it, the first and the last one continue the change. Equal times count as no turn.
std::vector<ImageMotion> turning_motions(const Pinhole& pinhole, const std::vector<Timestamp>& times,
                                         const std::vector<Corners>& views);

/// The corners of each view at the time of its middle row. `motions` has one entry per view;
/// unknown: the rows of that view are straight.
std::vector<Corners> straighten_rows(const Rectification& rectification, double row_time_s,
                                     const std::vector<ImageMotion>& motions,
                                     const std::vector<Corners>& views);

}  // namespace edgevo
