// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ground truth of any dataset in one format: TUM lines `t tx ty tz qx qy qz qw`, T_world_cam of the source's
// camera (x right, y down, z forward), metres, with the times of its frames.
#include <string>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// Text of a TUM trajectory file; empty if the source has no ground truth. Files in TUM format are passed
/// through unchanged; KITTI's poses (of camera 0, moved along the baseline to the chosen camera) and EuRoC's
/// (of the body, moved by the camera's mount) are converted, as are those of the boat of Symphony Lake.
/// Throws InputError for a file that cannot be read.
std::string ground_truth_tum(const SourceOptions& options, const ImageSource& source);

/// Text of a TUM trajectory file for frames played backward: each time t becomes first + last - t, where
/// `first` and `last` are the times of the first and the last frame, and the last pose comes first. Poses
/// before time 0 are dropped. Throws InputError for a line without a time.
std::string played_backward(const std::string& tum, Timestamp first, Timestamp last);

}  // namespace edgevo
