#pragma once
// Edge points as ViSP's visual features, the same points by name from the taught view to the last.
//
//   ServoPoints points(pinhole);
//   points.choose(taught, 20);                       // spread over the image, of well-known depth
//   const auto desired = points.features(taught);    // x*, y*, Z*
//   ... loop:  const auto current = points.features(feed.pose(now));   // the same points in the same order
//
// A point is a 3D point of the map, seen through the newest pose: its coordinates are those of the map's
// geometry, corrected by every edge that the frame was aligned with, not the noise of a single pixel. While
// its keyframe is in the window its depth and place follow the adjustment; later they stay. Belongs to the
// loop's thread.
//
// Distributed under the GPL when linked, as ViSP is (see LICENSE).
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/visual_features/vpFeaturePoint3D.h>

#include <memory>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/visp_bridge/servo_feed.h"

namespace edgevo {

/// Which points are chosen.
struct ServoPointsOptions {
  double max_relative_sigma = 0.05;  ///< of the depth of a point that is chosen
  double border_px = 20;             ///< chosen points keep this distance from the image border
};

/// One point at the pose that was asked for. Lengths in metres, as ServoPose's.
struct ServoPoint {
  int host_keyframe = -1, host_pixel = -1;  ///< its name in the map
  vpFeaturePoint point;                     ///< x = X/Z, y = Y/Z (normalised, undistorted), Z
  vpFeaturePoint3D point3d;                 ///< X, Y, Z
  double sigma_x = 0, sigma_y = 0;          ///< one standard deviation of x and y, pose and depth; normalised
  double sigma_Z = 0;    ///< of Z, metres
  bool in_view = false;  ///< in front of the camera and inside the image
};

/// The chosen points.
class ServoPoints {
 public:
  /// `pinhole` of the undistorted images: Run::pinhole, or Camera::pinhole.
  explicit ServoPoints(const Pinhole& pinhole, const ServoPointsOptions& options = {})
      : pinhole_(pinhole), options_(options) {}

  /// Chooses up to `count` points of the map in view at `pose`, far from each other in the image; what was
  /// chosen before is forgotten. Returns how many there are (0 without a usable pose). Cost: about 1 ms for
  /// 20 of 1500.
  int choose(const ServoPose& pose, int count);
  /// The chosen points at `pose`, in the order in which they were chosen; all of them, whether in view or
  /// not. Empty when the pose is not usable or belongs to another map than they do (ServoPose::map_version):
  /// stop, and choose again.
  std::vector<ServoPoint> features(const ServoPose& pose);

 private:
  struct Chosen {
    int host_keyframe, host_pixel;
    Eigen::Vector3d p_map;  ///< map units
    Eigen::Vector3d
        sigma_map;  ///< one standard deviation of the depth, along the ray that it was measured on
  };
  static Chosen make(const CloudPoint& point, const Reference& reference);
  void follow_map(const std::shared_ptr<const Reference>& reference);

  Pinhole pinhole_;
  ServoPointsOptions options_;
  std::vector<Chosen> chosen_;
  int map_version_ = -1;
  std::shared_ptr<const Reference> followed_;
};

}  // namespace edgevo
