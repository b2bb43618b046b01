// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The metric scale of a run, as --scale requests it: feed it with the events of the run, then convert the
// finished run.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/map/map_event.h"
#include "edgevo/scale/live_scale.h"
#include "edgevo/scale/run_scale.h"

namespace edgevo {

/// The scale of one run, from its first frame to its end.
class RunScaling {
 public:
  /// `requested` as --scale gives it; the tracks are read from `source`. Throws InputError: the source of
  /// images recorded no such sensor, or, for the only source of scale, not while its images were taken.
  RunScaling(const ScaleSources& requested, const ImageSource& source, const Pinhole& pinhole,
             const ScaleParams& params);

  /// As above, for a run whose source is no longer open: `tracks` are what it recorded.
  RunScaling(const ScaleSources& requested, VehicleTracks tracks, const Pinhole& pinhole,
             const std::optional<SE3>& T_vehicle_cam, const ScaleParams& params);

  /// Follows the run: all its events, in their order. Does nothing unless the scale is measured along the
  /// run.
  void apply(const MapEvent& event);
  /// The newest estimate of metres per unit of the live poses: the given factor, or what was measured so far;
  /// nothing without one. A segment that has none yet has that of the one before.
  std::optional<ScaleEstimate> newest() const;
  /// The tracks of the sensors that the scale is measured from; empty if none is needed.
  const VehicleTracks& tracks() const { return tracks_; }
  /// Converts the finished run to metres if that was requested and is possible; else Run::scale.problem says
  /// why not.
  void convert(Run* run) const;

 private:
  void add_waiting();
  void follow(const EpochsPlaced& epochs);

  ScaleSources requested_;
  ScaleParams params_;
  VehicleTracks tracks_;
  LiveScale live_;
  /// By segment.
  std::map<int, Sim3> T_odom_map_;
  /// Keyframes that count once the next frame has come, unless that begins a segment: until it has a scale of
  /// its own, a segment has the one that the last frame before it had.
  std::vector<KeyframeMarginalised> waiting_;
};

}  // namespace edgevo
