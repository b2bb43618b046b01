// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A vehicle that is followed looks far away, and the pose agrees with it: it is a rigid texture that stays in
// view, while what is near is soon gone. So nothing contradicts the pose, which turns as the vehicle does.
// What is near alone measures the pose, too. If that one differs by more than its covariance allows
// (Hausman, Econometrica 46, 1978), something that looks far pulls; it is a group if the pose without the
// group agrees.
#include "edgevo/alignment/reference.h"
#include "moving_group.h"

namespace edgevo {

/// Finds a group that pulls the pose away from that of what is near. No points if there is none. Cost: 0.5 ms
/// for 500 points, 2 ms more where the two poses differ.
MovingGroup find_pulling_group(const FramePyramid& current, const Reference& reference, const SE3& T_cur_ref,
                               const AlignmentParams& params);

}  // namespace edgevo
