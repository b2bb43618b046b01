// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Metres per unit of the live poses, as known while the run goes.
#include <map>
#include <optional>
#include <vector>

#include "edgevo/map/map_event.h"
#include "edgevo/scale/live_scale.h"

namespace edgevo {

/// Follows the events of a run. For one thread.
class LiveMetres {
 public:
  /// As RunScaling (scale/run_scaling.h).
  LiveMetres(const ScaleSource& source, const VehicleTrack& track, const Pinhole& pinhole,
             const std::optional<SE3>& T_vehicle_cam, const ScaleParams& params);

  /// Follows the run: all its events, in their order.
  void apply(const MapEvent& event);
  /// Whether there are to be metres.
  bool is_metric() const { return source_.kind != ScaleSource::Kind::kNone; }
  /// Takes an estimate of others.
  void set(double factor, double sigma) { newest_ = {factor, sigma, 0}; }
  /// The newest estimate; nothing without one so far. A segment that has none has the one before it.
  const std::optional<ScaleEstimate>& newest() const { return newest_; }

 private:
  void add_waiting();
  void follow(const EpochsPlaced& epochs);

  const ScaleSource source_;
  LiveScale live_;
  std::optional<ScaleEstimate> newest_;
  std::map<int, Sim3> T_odom_map_;  // by segment
  // Keyframes that count once the next frame has come, unless that begins a segment.
  std::vector<KeyframeMarginalised> waiting_;
};

}  // namespace edgevo
