#pragma once
// Virtual KITTI: rendered drives with exact depth and pose for every frame, in the layouts of both releases.
//
//   1.3.1   vkitti_1.3.1_rgb/WORLD/VARIATION/00000.png ..            the folder to name
//           vkitti_1.3.1_depthgt/WORLD/VARIATION/00000.png ..        16 bits, centimetres, 65535 for the sky
//           vkitti_1.3.1_extrinsicsgt/WORLD_VARIATION.txt            a header, then `frame` and 16 numbers: world to
//                                                                    camera, row by row
//           K = 725 725 620.5 187 for all
//   2.0.3   SceneNN/VARIATION                                        the folder to name; Camera_0 (default) and Camera_1 in it
//           frames/rgb/Camera_0/rgb_00000.jpg ..
//           frames/depth/Camera_0/depth_00000.png ..                 as above
//           extrinsic.txt                                            a header, then `frame camera` and 16 numbers
//           intrinsic.txt                                            a header, then `frame camera fx fy cx cy`
//           Where the archives were unpacked apart (vkitti_2.0.3_rgb, _depth, _textgt), the folder under vkitti_2.0.3_rgb.
//
// The camera's axes are ours (x right, y down, z forward) and pixel (0,0) is the centre of the top-left one in both. There are no
// times: frames are taken to be 0.1 s apart, as KITTI's are. Cars that drive by themselves are in the depth, but not in the
// poses.
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// A sequence as its lists and calibration tell it.
struct VirtualKitti {
  std::string release;      ///< "1.3.1" or "2.0.3"
  std::string camera_name;  ///< "Camera_0"; empty for 1.3.1
  Camera camera;  ///< without distortion
  std::vector<std::string> images;  ///< paths, in order
  std::vector<std::string> depths;  ///< where the depth of each image is; whether it is there shows when it is read
  std::vector<Timestamp> times;  ///< of each image, 0.1 s apart
  std::string poses_path;        ///< empty where the poses were not downloaded
  std::vector<SE3> T_world_cam;  ///< of each image, metres; empty without poses
};

/// The folder is one of a Virtual KITTI sequence.
bool is_virtual_kitti(const std::string& folder);

/// `path` and `sensor_label` of the options are used (and `fps` for the times). Reads lists, calibration and poses. Throws
/// InputError: no such camera, a list that is not readable, a frame without a pose, a matrix that is no rigid motion.
VirtualKitti read_virtual_kitti(const SourceOptions& options);

/// z in metres, row by row; 0 for the sky. Throws InputError: missing, damaged, not 16 bits, not width x height.
std::vector<float> read_virtual_kitti_depth(const std::string& path, int width, int height);

}  // namespace edgevo
