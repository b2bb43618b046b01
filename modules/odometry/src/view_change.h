#pragma once
// How the image of known points changes by a motion of the camera.
#include <optional>
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Rms image motion of the points from one pose to another, over those that lie before the camera in both and
/// inside its image in the first; 0 where there are none. Poses: from the points' frame to the camera. Cost:
/// two projections a point.
double rms_flow_px(const Pinhole& pinhole, const std::vector<CloudPoint>& points, const SE3& T_a_points,
                   const SE3& T_b_points);

struct ViewChange {
  double flow_px =
      0;  ///< rms image motion by the translation alone: the parallax that depth can be learnt from
  double view_share = 0;  ///< of the points, still in the image
};

/// Of points given in the camera `from`. Nothing where all of them are behind the camera then. Cost: two
/// projections a point.
std::optional<ViewChange> view_change(const Pinhole& pinhole, const std::vector<CloudPoint>& points,
                                      const SE3& T_to_from);

/// Up to about `count` points of the cloud that the camera sees, in its own axes.
std::vector<CloudPoint> visible_points(const Pinhole& pinhole, const ReferenceCloud& cloud,
                                       const SE3& T_cam_ref, size_t count);

/// Thresholds of image motion are stated at this width, and follow the width of the images.
constexpr double kReferenceWidth = 1241;  // pixels, that of KITTI's images, on which they were stated first

/// Image motion as it would be in images of kReferenceWidth.
inline double at_reference_width(const Pinhole& pinhole, double px) {
  return px * (kReferenceWidth / pinhole.width);
}

}  // namespace edgevo
