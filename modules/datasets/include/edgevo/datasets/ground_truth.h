#pragma once
// Ground truth of a dataset as one format: TUM lines `t tx ty tz qx qy qz qw`, T_world_cam of the camera that
// the source plays (x right, y down, z forward), metres, in the clock of its frames.
#include <string>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// Text of a TUM trajectory file; empty if there is no ground truth beside the source. Files in the TUM
/// format are passed on as they are; KITTI's poses (of camera 0, moved along the baseline to the chosen
/// camera) and EuRoC's (of the body, moved by the camera's mount) are converted, as are those of the boat of
/// Symphony Lake. Throws InputError for a file that is not readable.
std::string ground_truth_tum(const SourceOptions& options, const ImageSource& source);

/// The text of a TUM trajectory file for frames that are played backward: the times mirrored between the
/// first and the last frame's, t to first + last - t, the last pose first. Poses that would come before time
/// 0 are left out. Throws InputError for a line without a time.
std::string played_backward(const std::string& tum, Timestamp first, Timestamp last);

}  // namespace edgevo
