// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Edge points as ViSP's visual features, the same points from the taught view to the last.
//
//   ServoPoints points(pinhole);
//   points.choose(taught, 20);                       // spread over the image, of well-known depth
//   const auto desired = points.features(taught);    // x*, y*, Z*
//   ... loop:  const auto current = points.features(feed.pose(now));   // the same points in the same order
//
// A point is a 3D point of the map, projected with the newest pose. Its noise is therefore that of the pose,
// to which all edges of the frame contribute, not that of a single pixel. While its keyframe is in the
// window, its depth and position follow the adjustment; later they are fixed. For use in the thread of the
// loop.
//
// Distributed under the GPL when linked, as ViSP is (see LICENSE).
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/visual_features/vpFeaturePoint3D.h>

#include <memory>
#include <vector>

#include "edgevo/alignment/reference.h"
#include "edgevo/core/camera.h"
#include "edgevo/visp_bridge/servo_feed.h"

namespace edgevo {

/// Conditions on points to be chosen.
struct ServoPointsOptions {
  /// Largest standard deviation of the depth divided by the depth.
  double max_relative_sigma = 0.05;
  /// Smallest distance from the image border, pixels.
  double border_px = 20;
};

/// A point seen from the requested pose. Lengths in the unit of that ServoPose (metres if its scale is
/// metric).
struct ServoPoint {
  /// Identity of the point in the map: its host keyframe and the edge pixel there.
  int host_keyframe = -1, host_pixel = -1;
  /// Feature x = X/Z, y = Y/Z (normalised, undistorted) with depth Z.
  vpFeaturePoint point;
  /// Feature X, Y, Z in the camera frame.
  vpFeaturePoint3D point3d;
  /// Standard deviations of x and y due to pose and depth; normalised.
  double sigma_x = 0, sigma_y = 0;
  /// Standard deviation of Z.
  double sigma_Z = 0;
  /// Whether the point is in front of the camera and inside the image.
  bool in_view = false;
};

/// Chooses points and computes their features.
class ServoPoints {
 public:
  /// `pinhole` is the working pinhole of the run, as in Run::pinhole; by default Camera::pinhole().
  explicit ServoPoints(const Pinhole& pinhole, const ServoPointsOptions& options = {})
      : pinhole_(pinhole), options_(options) {}

  /// Chooses up to `count` points of the map in view at `pose`, far from each other in the image, in place of
  /// those chosen before. Returns their number (0 without a usable pose). Cost: about 1 ms for 20 of 1500.
  int choose(const ServoPose& pose, int count);
  /// All chosen points at `pose`, in view or not, in the order of choosing. Empty if the pose is not usable
  /// or belongs to another map than the points (ServoPose::map_version): stop and choose again.
  std::vector<ServoPoint> features(const ServoPose& pose);

 private:
  struct Chosen {
    int host_keyframe, host_pixel;
    /// Position in the map, map units.
    Eigen::Vector3d p_map;
    /// Vector of one standard deviation of the depth along the ray that it was measured on, map units.
    Eigen::Vector3d sigma_map;
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
