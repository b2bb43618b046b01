#pragma once
// What reader and writer of Symphony Lake share: the name of a survey's list, where the boat carries its
// camera, how that looks, and the names of its images. World: x east, y north, z up; boat: x forward, y left,
// z up.
#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo::symphony {

/// The list of a survey's images; spelled so.
constexpr const char* kSurveyList = "image_auxilliary.csv";

// As a user of the data gives them: metres, in the boat's axes.
const Eigen::Vector3d kCameraOnBoat(-0.420, 0, 0.255);
const Eigen::Vector3d kAntennaOnBoat(0.080, -0.118, 0.010);

/// The lens of the images as the camera took them, by a user's calibration: fx, fy, cx, cy and plumb-bob
/// coefficients.
const Camera kCalibrated{{759.308, 690.44, 370.915, 250.909, 704, 480},
                         {-0.302805, 0.171088, 0.001151, -0.00038, 0}};
/// The camera of images from which another user has taken the distortion out.
const Pinhole kRectified{780.17, 708.38, 317.75, 246.80, 700, 480};

/// T_boat_cam. `pan` turns the view to starboard (its direction is heading - pan), `tilt` lifts it; radians.
/// Of tilt nobody tells the sign: up is what makes a right-handed pair with pan, about axes that point down
/// and to the right.
inline SE3 camera_on_boat(double pan, double tilt) {
  const Eigen::Vector3d forward(std::cos(pan) * std::cos(tilt), -std::sin(pan) * std::cos(tilt),
                                std::sin(tilt));
  const Eigen::Vector3d right(-std::sin(pan), -std::cos(pan), 0);
  Eigen::Matrix3d R;
  R.col(0) = right, R.col(1) = forward.cross(right), R.col(2) = forward;
  return {R, kCameraOnBoat};
}

/// T_world_boat of a boat that floats level; metres, heading in radians from x (east) to the left.
inline SE3 boat_in_plane(const Eigen::Vector2d& position, double heading) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ())),
          {position.x(), position.y(), 0}};
}

/// What is known of the lens at a zoom, and why.
struct Lens {
  Distortion distortion;
  const char* says;
};

/// The lens stands in no row of a survey. The images of the archive are as the camera took them: at the focal
/// lengths of the known calibration they have its distortion. Focal lengths nearer to those of rectified
/// images tell of rectified images, which have none; of any other zoom nothing is known.
Lens lens_at(const Pinhole& pinhole);

/// "0012/0345.jpg" and "0012/12345.jpg" of image 12345, as older and newer copies of the archive name it.
std::string older_name(int number);
std::string newer_name(int number);

}  // namespace edgevo::symphony
