// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The motion of the image while a rolling shutter reads it: as expected before a frame is tracked, and as
// measured by tracking.
#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/image_correction.h"
#include "edgevo/edges/image_motion.h"

namespace edgevo {

/// How the rows of a frame's image were rectified.
struct RowRectification {
  /// row_time(), seconds; 0: a global shutter.
  double row_time_s = 0;
  /// Motion that was expected, for which the rows were rectified.
  ImageMotion expected;
  /// Cameras of the raw and of the rectified images.
  Rectification cameras = {};

  /// Whether the rows were taken one after another.
  bool is_rolling() const { return row_time_s != 0; }
};

/// Image motion of a camera that sees the cloud from T_cur_ref and moves by `twist` (of points in the camera
/// frame, per second). Cells without points take the inverse depths of their neighbours, or `median_idepth`
/// if next to nothing is in view. Cost: one projection per point, and some 20 microseconds.
ImageMotion image_motion(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                         const Vector6d& twist, double median_idepth);

/// Shifts a cloud to where an image shows it that was rectified for `expected` while the camera moved as in
/// `measured`: its points project to their positions in this image. The result has no patches.
ReferenceCloud shift_cloud(const Rectification& rectification, const ReferenceCloud& cloud,
                           const SE3& T_cur_ref, double row_time_s, const ImageMotion& expected,
                           const ImageMotion& measured);

/// Shifts a ray (x, y, 1) measured in an image rectified for `expected` to where it is in one rectified for
/// `measured`.
Eigen::Vector3d shift_ray(const Rectification& rectification, double row_time_s, const ImageMotion& expected,
                          const ImageMotion& measured, const Eigen::Vector3d& ray);

}  // namespace edgevo
