// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the image of known points changes by a motion of the camera.
#include <optional>
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Rms image motion of the points from one pose to another, in pixels, over those in front of the camera in
/// both and inside its image in the first; 0 if there are none. Poses: from the points' frame to the camera.
/// Cost: two projections per point.
double rms_flow_px(const Pinhole& pinhole, const std::vector<CloudPoint>& points, const SE3& T_a_points,
                   const SE3& T_b_points);

/// Change of the view by a motion of the camera.
struct ViewChange {
  /// Rms image motion by the translation alone, in pixels: the parallax that depth can be learnt from.
  double flow_px = 0;
  /// Share of the points that are still in the image, 0 to 1.
  double view_share = 0;
};

/// Change of the view of points given in the camera `from`; nothing if all of them are behind the camera
/// `to`. Cost: two projections per point.
std::optional<ViewChange> view_change(const Pinhole& pinhole, const std::vector<CloudPoint>& points,
                                      const SE3& T_to_from);

/// About `count` points of the cloud, at most, that the camera sees, in its own axes.
std::vector<CloudPoint> visible_points(const Pinhole& pinhole, const ReferenceCloud& cloud,
                                       const SE3& T_cam_ref, size_t count);

/// Width in pixels at which thresholds of image motion are stated; they scale with the width of the images.
constexpr double kReferenceWidth = 1241;  // that of KITTI's images

/// Converts image motion to pixels at kReferenceWidth.
inline double at_reference_width(const Pinhole& pinhole, double px) {
  return px * (kReferenceWidth / pinhole.width);
}

}  // namespace edgevo
