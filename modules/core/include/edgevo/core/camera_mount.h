// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a camera is mounted on its vehicle, in three angles.
//
// The vehicle's axes are x forward, y left, z up (REP-103). With all angles 0 the camera looks straight ahead
// and is level. The angles turn the camera about the fixed axes of the vehicle, right-handed, roll first,
// then pitch, then yaw: R_vehicle_cam = Rz(yaw) Ry(pitch) Rx(roll) R_ahead, as rpy in URDF and yaw, pitch,
// roll in MRPT do for a camera body whose x axis is the optical axis.
//
//   pitch > 0   looks down:    "0,20,0" is a camera 20 degrees down
//   yaw > 0     looks left:    "0,0,90" looks to the left
//   roll > 0    turned clockwise, as seen from behind it: "180,0,0" is upside down
#include <string>
#include <vector>

#include "edgevo/core/se3.h"

namespace edgevo {

/// Mount of a camera.
struct CameraMount {
  /// Angles, degrees.
  double roll_deg = 0, pitch_deg = 0, yaw_deg = 0;
  /// Position of the camera in the vehicle's axes, metres.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// The mount as a transform: p_vehicle = T p_cam, with the camera's axes x right, y down, z forward.
SE3 T_vehicle_cam(const CameraMount& mount);

/// The angles of a transform: pitch -90 to 90, roll and yaw -180 to 180; at pitch +-90 roll is 0.
CameraMount camera_mount(const SE3& T_vehicle_cam);

/// The mount of three angles, or of three angles and a position. Throws InputError opened by `where`: another
/// count of numbers, one that is not finite, an angle beyond +-360 degrees, a position beyond a kilometre.
CameraMount camera_mount(const std::vector<double>& numbers, const std::string& where);

/// Parses "roll,pitch,yaw" or "roll,pitch,yaw,x,y,z". Throws InputError.
CameraMount parse_camera_mount(const std::string& text, const std::string& where);

/// The mount in words: "looks 20.0 degrees down and 0.0 to the left, turned 0.0 clockwise".
std::string describe(const CameraMount& mount);

}  // namespace edgevo
