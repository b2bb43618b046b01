// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What one source has measured along one path, and its scale over intervals of it.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/scale_params.h"
#include "edgevo/scale/scale_source.h"
#include "edgevo/scale/track_scale.h"

namespace edgevo {

/// The samples of a source along a path, by travelled distance.
struct SourceSamples {
  ScaleSource source;
  /// Of a sensor of the vehicle: its positions, and where it is in the camera's axes, metres.
  std::vector<TrackPair> pairs;
  Eigen::Vector3d sensor_in_camera = Eigen::Vector3d::Zero();
  /// Of the ground: heights of the camera.
  std::vector<HeightSample> heights;
};

/// Those of a source whose sensor has a track; without any for other sources. `T_vehicle_cam`: mount of the
/// camera, if known.
SourceSamples positions_along(const Path& path, const ScaleSource& source, const VehicleTracks& tracks,
                              const std::optional<SE3>& T_vehicle_cam);

/// The scale over one interval.
struct IntervalFit {
  ScaleEstimate scale;
  /// Of positions: rotation from the world of the run to the sensor's axes.
  Eigen::Matrix3d R_sensor_world = Eigen::Matrix3d::Identity();
  /// Of positions; TrackJump::at is a position in SourceSamples::pairs.
  std::vector<TrackJump> jumps;
  /// Of positions: those that are scattered, as positions in SourceSamples::pairs.
  std::vector<size_t> scattered;
};

/// Between two travelled distances, units of the run; nullopt if that interval determines no scale. Without
/// the uncertainty that all intervals have in common (common_sigma()).
std::optional<IntervalFit> fit_interval(const SourceSamples& samples, double begin, double end,
                                        const ScaleParams& params);

/// Metres per unit over the whole path, roughly; nullopt if there is none.
std::optional<double> rough_scale(const SourceSamples& samples, const ScaleParams& params);

/// Relative standard deviation of what all intervals of a source have in common: for the camera's height,
/// height and ground.
double common_sigma(const ScaleSource& source, const ScaleParams& params);

}  // namespace edgevo
