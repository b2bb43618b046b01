// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Virtual KITTI: rendered drives with exact depth and pose for every frame, in the layouts of both releases.
//
//   1.3.1   vkitti_1.3.1_rgb/WORLD/VARIATION/00000.png ..       the folder to name
//           vkitti_1.3.1_depthgt/WORLD/VARIATION/00000.png ..   16 bits, centimetres, 65535 for the sky
//           vkitti_1.3.1_extrinsicsgt/WORLD_VARIATION.txt       a header, then `frame` and 16 numbers: world
//                                                               to camera, row by row
//           K = 725 725 620.5 187 for all
//   2.0.3   SceneNN/VARIATION                           the folder to name; Camera_0 (default) or 1
//           frames/rgb/Camera_0/rgb_00000.jpg ..
//           frames/depth/Camera_0/depth_00000.png ..    as above
//           extrinsic.txt                               a header, then `frame camera` and 16 numbers
//           intrinsic.txt                               a header, then `frame camera fx fy cx cy`
//           For archives unpacked separately (vkitti_2.0.3_rgb, _depth, _textgt): the folder under
//           vkitti_2.0.3_rgb.
//
// The camera's axes are ours (x right, y down, z forward) and pixel (0,0) is the centre of the top-left one
// in both. There are no times: frames are taken to be 0.1 s apart, as KITTI's are. Moving cars are in the
// depth but not in the poses.
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/input_decision.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// A sequence as its lists and calibration describe it.
struct VirtualKitti {
  /// Release: "1.3.1" or "2.0.3".
  std::string release;
  /// Name of the camera, "Camera_0"; empty for 1.3.1.
  std::string camera_name;
  /// Camera of the images, without distortion.
  Camera camera;
  /// What was decided about the camera, if a file was given for it.
  std::vector<InputDecision> decisions;
  /// Paths of the images, in order.
  std::vector<std::string> images;
  /// Path of each image's depth; existence is checked when it is read.
  std::vector<std::string> depths;
  /// Time of each image, 0.1 s apart.
  std::vector<Timestamp> times;
  /// Path of the poses; empty if they were not downloaded.
  std::string poses_path;
  /// Pose of each image, metres; empty without poses.
  std::vector<SE3> T_world_cam;
};

/// True if the folder holds a Virtual KITTI sequence.
bool is_virtual_kitti(const std::string& folder);

/// Reads lists, calibration and poses. Uses `path` and `sensor_label` of the options (and `fps` for the
/// times). Throws InputError: no such camera, an unreadable list, a frame without a pose, a matrix that is
/// not a rigid motion.
VirtualKitti read_virtual_kitti(const SourceOptions& options);

/// Depth z in metres, row by row; 0 for the sky. Throws InputError: missing, damaged, not 16 bits, not width
/// x height.
std::vector<float> read_virtual_kitti_depth(const std::string& path, int width, int height);

}  // namespace edgevo
