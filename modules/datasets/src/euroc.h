#pragma once
// Parts of the EuRoC (ASL) layout that sequence and ground truth share.
#include <string>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// ".../mav0/cam0" of the chosen camera. Throws InputError.
std::string euroc_camera_folder(const SourceOptions& options);

/// Mount of the camera in the body frame (the IMU's; not x forward, z up): T_BS of its sensor.yaml. Throws
/// InputError.
SE3 read_euroc_T_body_cam(const std::string& camera_folder);

/// ".../mav0/state_groundtruth_estimate0/data.csv"; empty if there is none.
std::string euroc_ground_truth_path(const std::string& folder);

/// Whole nanoseconds. Throws InputError opened by `where`.
Timestamp parse_nanoseconds(const std::string& text, const std::string& where);

}  // namespace edgevo
