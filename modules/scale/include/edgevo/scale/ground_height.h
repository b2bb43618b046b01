// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The height of the camera over the ground, measured from edges on the ground: lane marks, kerbs, cracks,
// shadows.
//
// Each edge point is evaluated at the moment the camera passes it, or has passed it, driving backwards.
// There, the ground under the camera's path lies one camera height below it, whatever the pitch of the
// camera: the ground normal is the camera's downward direction (its y axis, or that of the mount) made
// perpendicular to the direction of travel, and the camera height over a point is the distance to it along
// this normal. Points far to the side are skipped (parked cars, kerbs, a cambered road). The remaining points
// that are not on the ground lie above it, at many heights; the ground is the height at which most points lie
// (the mode). Beyond the end of the path, points up to a few camera heights away are evaluated with the last
// direction of travel.
//
// Source: scale from a ground plane of known distance follows Song and Chandraker (2014) and Zhou et al.
// (2016, for edges and dense roads); evaluating points where they are passed is what sparse edges allow.
#include <optional>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_estimate.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// The height of the camera over one point on the ground.
struct HeightSample {
  /// Travelled distance at which the camera passes the point, units of the run.
  double distance = 0;
  /// Height of the camera over the point, units of the run, > 0.
  double height = 0;
  /// Id of the keyframe that hosts the point, if the caller sets it.
  int keyframe_id = -1;
};

/// Downward direction in the axes of a camera with this mount; the y axis if the mount is not known, or
/// within a degree of level: the estimate does not depend on the pitch.
Eigen::Vector3d down_in_camera(const std::optional<SE3>& T_vehicle_cam);

/// Samples from the points of `keyframe`, whose frame must be in `path`, that the camera passes within the
/// driven corridor (`ground_width`). Points not yet passed are skipped unless `is_path_ended`. Cost: points x
/// frames until they are passed. `down`: as down_in_camera().
std::vector<HeightSample> ground_heights(const Pinhole& pinhole, const KeyframeRecord& keyframe,
                                         const Eigen::Vector3d& down, const Path& path, bool is_path_ended,
                                         const ScaleParams& params);

/// Those of all keyframes whose frames are in `path`, a part of the finished run's, which has ended.
std::vector<HeightSample> ground_heights(const Run& run, const Path& path, const ScaleParams& params);

/// The scale that puts the mode of the heights at `camera_height` (metres). nullopt for too few points, or
/// when no height stands out.
std::optional<ScaleEstimate> fit_height(const std::vector<HeightSample>& samples, double camera_height,
                                        const ScaleParams& params);

/// Height of the camera over the ground along the whole run, units of the run, from the keyframes alone;
/// nullopt when no ground stands out.
std::optional<double> seen_camera_height(const Run& run, const ScaleParams& params);

}  // namespace edgevo
