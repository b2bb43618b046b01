// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The metric scale of a run, as --scale requests it: feed it with each frame, then apply it to the finished
// run.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/scale/live_scale.h"
#include "edgevo/scale/run_scale.h"

namespace edgevo {

/// The scale of one run, from its first frame to its end.
class RunScaling {
 public:
  /// `requested` as --scale gives it; the tracks are read from `source`. Throws InputError: the source of
  /// images recorded no such sensor, or not while its images were taken.
  RunScaling(const ScaleSource& requested, const ImageSource& source, const ScaleParams& params);

  /// As above, for a run whose source is no longer open: `track` is what it recorded.
  RunScaling(const ScaleSource& requested, VehicleTrack track, const Pinhole& pinhole,
             const std::optional<SE3>& T_vehicle_cam, const ScaleParams& params);

  /// True if the scale is measured, which needs each frame and keyframe during the run.
  bool is_estimated() const { return requested_.is_estimated(); }
  /// Call after each frame, with the keyframes marginalised since the frame before. Does nothing unless
  /// is_estimated().
  void add_frame(const FrameRecord& frame, const std::vector<KeyframeRecord>& marginalised);
  /// The sensor's track that the scale is measured from; empty if none is needed.
  const VehicleTrack& track() const { return track_; }
  /// Converts the finished run to metres if that was requested and is possible; else Run::scale.problem says
  /// why not.
  void apply(Run* run) const;

 private:
  ScaleSource requested_;
  ScaleParams params_;
  VehicleTrack track_;
  LiveScale live_;
};

}  // namespace edgevo
