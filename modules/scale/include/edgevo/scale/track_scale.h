#pragma once
// The scale from another sensor's positions of the vehicle: the similarity between the two paths over a stretch (Umeyama 1991).
//
// The run's positions are the source and the sensor's the target of the fit, so that noise of the sensor does not bend the scale: it is
// the regression of a noisy path on a smooth one. The frames of the two need not be known to each other. Positions far off the fit
// (a GPS fix that jumped) are left out, twice.
#include <optional>
#include <vector>

#include "edgevo/core/vehicle_track.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_estimate.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// One position of the sensor, and where the run says the camera was at that time.
struct TrackPair {
  double way = 0;  ///< of the path at that time, units of the run
  SE3 T_world_cam;  ///< at that time, interpolated, units of the run
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres
};

/// Pairs for all positions between two poses of `path` at most half a second apart (interpolated), in time order. Linear.
std::vector<TrackPair> pair_up(const Path& path, const VehicleTrack& track);

/// With fewer positions a path tells no scale.
constexpr size_t kMinTrackPairs = 8;

/// `sensor_in_camera`: where the sensor sits, camera axes, metres (zero if nobody knows). nullopt for fewer
/// than kMinTrackPairs, a path that stands still, and an estimate worse than max_sigma.
std::optional<ScaleEstimate> fit_track(const std::vector<TrackPair>& pairs, const Eigen::Vector3d& sensor_in_camera,
                                       const ScaleParams& params);

}  // namespace edgevo
