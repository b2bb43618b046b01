// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Pose of the camera on the body that a ground truth describes. That need not be the camera: the truth of a
// drive may be that of the GPS unit, turned by some degrees and a metre away. The absolute error hardly
// shows it, but in a turn of 35 degrees a camera a metre away moves by another 0.6 m.
#include "run_with_truth.h"

namespace edgevo {

/// T_body_cam from the motions over `ahead` frames: with M_body = T_body_cam M_cam T_body_cam^-1, a robust
/// fit (weights 1 / error) of the rotation to their directions and axes, and of the lever arm to their
/// lengths in turns. What the motions do not determine stays zero. The identity, unless the fit is a small
/// correction (at most 15 degrees) that reduces the median error by a third, and under which the rotations
/// fit as well as before: where translations are bad, some turn of the camera often makes them look better.
SE3 truth_mount(const RunWithTruth& run, const StepScale& scales, int ahead, int scale_steps,
                int fewest_steps);

}  // namespace edgevo
