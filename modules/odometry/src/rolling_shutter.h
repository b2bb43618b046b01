#pragma once
// The motion of the image while a rolling shutter reads it: what the odometry expects of the next frame, and
// what tracking makes of it.
#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/image_correction.h"
#include "edgevo/edges/image_motion.h"

namespace edgevo {

/// How the rows of a frame's image were rectified: for the motion that was expected of it.
struct RowRectification {
  double readout_s = 0;  ///< from the first row to the last; 0: a global shutter
  ImageMotion expected;

  bool is_rolling() const { return readout_s != 0; }
};

/// Of a camera that sees the cloud from T_cur_ref and moves by `twist` (of points in the camera frame, a
/// second). Cells without points take the inverse depths of their neighbours, all of them `median_idepth`
/// where next to nothing is in view. Cost: a projection a point, and some 20 microseconds.
ImageMotion image_motion(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                         const Vector6d& twist, double median_idepth);

/// The images were made ready for `expected`, but the camera moved as in `measured`: the cloud's points moved
/// by what is left, so that they project to where this image shows them. Without patches.
ReferenceCloud shift_cloud(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                           double readout_s, const ImageMotion& expected, const ImageMotion& measured);

/// The same for a point that was seen in such an image, (x, y, 1): where it is in one made ready for
/// `measured`.
Eigen::Vector3d shift_ray(const Pinhole& pinhole, double readout_s, const ImageMotion& expected,
                          const ImageMotion& measured, const Eigen::Vector3d& ray);

}  // namespace edgevo
