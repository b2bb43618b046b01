// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A map after its camera was corrected (edges/image_correction.h): new positions of keyframes, points and
// matches. self_calibration makes revisions; Window::apply applies one to the window.
#include <Eigen/Core>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/image_correction.h"
#include "edgevo/edges/image_motion.h"

namespace edgevo {

/// A keyframe after a correction of the camera, in map coordinates.
struct RevisedKeyframe {
  /// Id of the keyframe.
  int id = 0;
  /// Pose after the correction.
  SE3 T_cam_world;
  /// Motion of the image: corrected pixels depend on it.
  ImageMotion motion;
  /// New length over old length near this keyframe.
  double length_ratio = 1;
  /// A point that the keyframe hosts.
  struct Point {
    /// Pixel in the host image with the new correction.
    Eigen::Vector2d px;
    /// Inverse depth 1/z in the host frame.
    double idepth = 0;
  };
  /// Hosted points, in the order of Keyframe::points.
  std::vector<Point> points;
};

/// A correction of the camera and all that changes with it.
struct MapRevision {
  /// The correction applied before, and the new one.
  ImageCorrection before, now;
  /// Remembered keyframes and those of the window, ascending id.
  std::vector<RevisedKeyframe> keyframes;
  /// Prior of the remembered keyframes on the window.
  BaPrior prior;

  /// Motion of the keyframe's image; no motion if the keyframe is not in the revision.
  const ImageMotion& motion_of(int keyframe_id) const;
};

/// New position of a pixel when an image of the given motion that was corrected by `before` is corrected by
/// `now` instead.
Eigen::Vector2d correct_pixel(const Pinhole& pinhole, const ImageCorrection& before,
                              const ImageCorrection& now, const ImageMotion& motion,
                              const Eigen::Vector2d& px);
/// New unit normal of the edge at `px` when an image corrected by `before` is corrected by `now` instead.
Eigen::Vector2d correct_normal(const Pinhole& pinhole, const ImageCorrection& before,
                               const ImageCorrection& now, const ImageMotion& motion,
                               const Eigen::Vector2d& px, const Eigen::Vector2d& normal);

}  // namespace edgevo
