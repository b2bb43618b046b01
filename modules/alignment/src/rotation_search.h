// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Search of rotations around a predicted pose on the coarsest level, for a camera that turned further from
// the prediction than the coarse patch alignment converges (about two pixels of that level).
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// The best few of a grid of rotations about x and y applied to `T_predicted`, best first; may be empty. They
/// are ranked by mean robust patch difference; patches out of view count as unrelated. Cost: 200 patches x
/// 209 rotations, about 4 ms, so it is meant for lost frames.
std::vector<SE3> search_rotation(const FramePyramid& current, const ReferenceCloud& cloud,
                                 const SE3& T_predicted);

}  // namespace edgevo
