#pragma once
// A map after its camera was corrected (edges/image_correction.h): where keyframes, points and matches lie
// then. self_calibration makes revisions; Window::apply moves the window by one.
#include <Eigen/Core>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/core/camera.h"
#include "edgevo/edges/image_correction.h"
#include "edgevo/edges/image_motion.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// What a keyframe became when the camera was corrected. Everything in map coordinates.
struct RevisedKeyframe {
  int id = 0;  ///< of the keyframe
  SE3 T_cam_world;  ///< after the correction
  ImageMotion motion;       ///< of its image: its pixels move with it
  double length_ratio = 1;  ///< new length over old length near this keyframe
  /// A point that the keyframe hosts.
  struct Point {
    Eigen::Vector2d px;  ///< in the host image as it is corrected now
    double idepth = 0;  ///< 1/z in the host frame
  };
  std::vector<Point> points;  ///< in the order of Keyframe::points
};

/// A correction of the camera and all that moves with it.
struct MapRevision {
  ImageCorrection before, now;  ///< what was applied, and what is
  std::vector<RevisedKeyframe> keyframes;  ///< remembered ones and the window's, ascending id
  BaPrior prior;                           ///< of the remembered ones on the window

  /// of the keyframe's image; one of no motion where the keyframe is not in the revision
  const ImageMotion& motion_of(int keyframe_id) const;
};

/// Images corrected by `before` are corrected by `now` instead: where a pixel of one that moved with `motion`
/// lies then, and its normal.
Eigen::Vector2d correct_pixel(const Pinhole& pinhole, const ImageCorrection& before,
                              const ImageCorrection& now, const ImageMotion& motion,
                              const Eigen::Vector2d& px);
/// The unit normal of the edge at `px`, likewise.
Eigen::Vector2d correct_normal(const Pinhole& pinhole, const ImageCorrection& before,
                               const ImageCorrection& now, const ImageMotion& motion,
                               const Eigen::Vector2d& px, const Eigen::Vector2d& normal);

}  // namespace edgevo
