// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/results/recovery_log.h"

namespace edgevo {

/// Sets the final poses of the frames of an interrupted run: each frame moves with the keyframe before it in
/// its segment, and its distance to that keyframe grows or shrinks as the distance between the keyframes has.
/// Frames of a segment without a keyframe keep their live poses.
void propagate_keyframe_poses(InterruptedRun* interrupted);

}  // namespace edgevo
