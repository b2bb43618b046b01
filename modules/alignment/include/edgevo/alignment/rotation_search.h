#pragma once
// Rotations near a predicted pose, tried on the coarsest level: for a camera that turned otherwise than
// predicted, further than the patches of the coarse start reach (about two of that level's pixels).
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// The likeliest few of a grid of rotations about x and y applied to `T_predicted`, best first; may be empty.
/// The score is the mean robust patch difference; patches out of view count as unrelated. Cost: 200 patches x
/// 209 rotations, about 4 ms: for lost frames.
std::vector<SE3> search_rotation(const FramePyramid& current, const ReferenceCloud& cloud,
                                 const SE3& T_predicted);

}  // namespace edgevo
