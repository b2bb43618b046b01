// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Common to reader and writer of Symphony Lake: the name of a survey's list, the mount of the camera on the
// boat, its viewing direction, and the names of its images. World: x east, y north, z up; boat: x forward, y
// left, z up.
#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo::symphony {

/// Name of the list of a survey's images; the spelling is theirs.
constexpr const char* kSurveyList = "image_auxilliary.csv";

/// Position of the camera in the boat's axes, metres, as published by a user of the data.
const Eigen::Vector3d kCameraOnBoat{-0.420, 0, 0.255};
/// Position of the GPS antenna in the boat's axes, metres, from the same source.
const Eigen::Vector3d kAntennaOnBoat{0.080, -0.118, 0.010};

/// Camera of the raw images by a user's calibration: fx, fy, cx, cy and plumb-bob coefficients.
const Camera kCalibrated{{759.308, 690.44, 370.915, 250.909, 704, 480},
                         {-0.302805, 0.171088, 0.001151, -0.00038, 0}};
/// Camera of images rectified by another user.
const Pinhole kRectified{780.17, 708.38, 317.75, 246.80, 700, 480};

/// T_boat_cam. `pan` turns the view to starboard (its direction is heading - pan), `tilt` raises it; radians.
/// The sign of tilt is undocumented: up makes pan and tilt right-handed, about axes that point down and to
/// the right.
inline SE3 camera_on_boat(double pan, double tilt) {
  const Eigen::Vector3d forward(std::cos(pan) * std::cos(tilt), -std::sin(pan) * std::cos(tilt),
                                std::sin(tilt));
  const Eigen::Vector3d right(-std::sin(pan), -std::cos(pan), 0);
  Eigen::Matrix3d R;
  R.col(0) = right, R.col(1) = forward.cross(right), R.col(2) = forward;
  return {R, kCameraOnBoat};
}

/// T_world_boat of a level boat; metres, heading in radians from x (east) to the left.
inline SE3 boat_in_plane(const Eigen::Vector2d& position, double heading) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ())),
          {position.x(), position.y(), 0}};
}

/// What is known of the lens at a zoom, and on what basis.
struct Lens {
  /// Distortion of the lens; none where nothing is known.
  Distortion distortion;
  /// Basis of that, as it is reported to the user.
  const char* says;
};

/// The lens at a focal length; it is in no row of a survey. The images of the archive are raw: at the focal
/// lengths of the known calibration they have its distortion. Focal lengths closer to those of rectified
/// images indicate rectified images, which have none; for any other zoom nothing is known.
Lens lens_at(const Pinhole& pinhole);

/// Name of image 12345 in older copies of the archive: "0012/0345.jpg".
std::string older_name(int number);
/// Name of image 12345 in newer copies of the archive: "0012/12345.jpg".
std::string newer_name(int number);

}  // namespace edgevo::symphony
