// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scale from another sensor's positions of the vehicle: the similarity between the two paths over an
// interval (Umeyama 1991).
//
// The run's positions are the source and the sensor's the target of the fit, so that sensor noise does not
// bias the scale: it is the regression of a noisy path on a smooth one. The transform between the two
// coordinate frames need not be known. Positions far off the fit (a GPS fix that jumped) are rejected, in two
// passes.
#include <optional>
#include <vector>

#include "edgevo/core/vehicle_track.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_estimate.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// One position of the sensor, and the camera pose of the run at that time.
struct TrackPair {
  /// Travelled distance along the path at that time, units of the run.
  double distance = 0;
  /// Camera pose at that time, interpolated, units of the run.
  SE3 T_world_cam;
  /// Position of the sensor, metres.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// Pairs for all positions between two poses of `path` that are at most half a second apart (interpolated),
/// in time order. Cost: linear.
std::vector<TrackPair> pair_up(const Path& path, const VehicleTrack& track);

/// Least number of positions for a scale estimate.
constexpr size_t kMinTrackPairs = 8;

/// `sensor_in_camera`: position of the sensor in camera axes, metres (zero if not known). nullopt for fewer
/// than kMinTrackPairs, a path without motion, and an estimate worse than max_sigma.
std::optional<ScaleEstimate> fit_track(const std::vector<TrackPair>& pairs,
                                       const Eigen::Vector3d& sensor_in_camera, const ScaleParams& params);

}  // namespace edgevo
