// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scale from another sensor's positions of the vehicle: the similarity between the two paths over an
// interval (Umeyama 1991).
//
// The run's positions are the source and the sensor's the target of the fit, so that sensor noise does not
// bias the scale: it is the regression of a noisy path on a smooth one. The transform between the two
// coordinate frames need not be known.
//
// Positions that are displaced against the others (a GPS fix, or a run of fixes, that jumped) have an
// offset of their own, where the residuals become more probable by it than a jump is improbable. Residuals
// are those of an autoregressive process: white as those of GPS, or a random walk as those of wheels.
//
// Single positions of an absolute sensor that lie apart from their neighbours in time, as of a receiver
// between houses, are excluded first: where there are many, no jump would stand out.
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
  /// Index of the first frame not before that time.
  int frame_index = 0;
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

/// A jump of a sensor's positions.
struct TrackJump {
  /// The first pair after it.
  size_t at = 0;
  /// Offset of the positions from there on against those before, in the sensor's axes, metres.
  Eigen::Vector3d by = Eigen::Vector3d::Zero();
};

/// A fit of the path to a sensor's positions.
struct TrackFit {
  /// Metres per unit.
  ScaleEstimate scale;
  /// Rotation from the world of the run to the sensor's axes.
  Eigen::Matrix3d R_sensor_world = Eigen::Matrix3d::Identity();
  /// Jumps, in time order.
  std::vector<TrackJump> jumps;
  /// Pairs whose positions lie apart from those before and after them; they do not count.
  std::vector<size_t> scattered;
};

/// How a sensor comes by its positions.
enum class PositionKind {
  kAbsolute,   ///< Each by itself, as GPS: single ones may be anywhere.
  kIntegrated  ///< Each from the one before, as wheels: an error stays.
};

/// `sensor_in_camera`: position of the sensor in camera axes, metres (zero if not known). nullopt for fewer
/// than kMinTrackPairs, a path without motion, and an estimate worse than max_sigma.
std::optional<TrackFit> fit_track(const std::vector<TrackPair>& pairs, PositionKind kind,
                                  const Eigen::Vector3d& sensor_in_camera, const ScaleParams& params);

/// Metres per unit by the lengths of steps, for a part of which positions may be anything; nullopt without
/// motion.
std::optional<double> rough_scale(const std::vector<TrackPair>& pairs);

}  // namespace edgevo
