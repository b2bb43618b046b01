// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motions between two views compared by the views between them. The corners of a plane fit two motions
// between two views equally well; the normal that the wrong one implies turns from view to view, that of a
// plane does not.
#include <optional>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/features/corner_tracking.h"
#include "edgevo/features/two_view_motion.h"

namespace edgevo {

/// Poses and depths adjusted to the corners of several views.
struct ViewFit {
  /// Motion from the first view to the last, |translation| = 1.
  SE3 T_last_first;
  /// Rms reprojection error over all corners and all views but the first, pixels; a single one counts as 2
  /// pixels at most.
  double error_px = 0;
};

/// Adjusts poses and depths, starting from a motion between the first view and the last. `views` holds the
/// same corners in each of three views or more, in order; `turn`, if there is one, is the rotation from the
/// first to the last as another sensor has measured it. Returns nothing if they do not constrain it. Cost:
/// some 5 ms for 300 corners in eight views.
std::optional<ViewFit> fit_views(const Pinhole& pinhole, const std::vector<Corners>& views,
                                 const SE3& T_last_first, const TurnOfViews* turn = nullptr);

/// Inverse depths in both cameras of a corner seen at rays a (first) and b (last); false behind a camera or
/// without parallax.
bool triangulate(const SE3& T_last_first, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                 double* idepth_first, double* idepth_last);

/// Pose of a view by PnP: `points` in the first camera are seen at `px`. `T_cam_first` is the start and the
/// result. Returns false if there is none.
bool place_view(const Pinhole& pinhole, const std::vector<cv::Point3f>& points, const Corners& px,
                SE3* T_cam_first);

}  // namespace edgevo
