#pragma once
// Parts of the KITTI odometry layout that sequence and ground truth share.
#include <array>
#include <string>

#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// "image_0": the label the user gave, else the first of image_0 .. image_3 that is there. Throws InputError.
std::string kitti_camera_folder(const SourceOptions& options);

/// The 3x4 projection matrix of that camera, row by row, from calib.txt. Throws InputError.
std::array<double, 12> read_kitti_projection(const SourceOptions& options, const std::string& camera_folder);

/// ../../poses/NN.txt beside sequences/NN; empty if there is none.
std::string kitti_poses_path(const std::string& folder);

}  // namespace edgevo
