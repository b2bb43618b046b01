// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Poses as lines of a TUM trajectory file.
#include <string>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Appends `t tx ty tz qx qy qz qw`, nine decimals.
void append_pose(std::string* text, Timestamp t, const SE3& T_world_cam);

}  // namespace edgevo
