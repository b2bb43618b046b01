#pragma once
// The metric scale of a run, as --scale asks for it: what is to be fed with each frame, and what is done with
// the finished run.
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
  /// `option` as --scale gives it, checked before `source` is asked for its tracks. Throws InputError: not a
  /// scale source; the source of images recorded no such sensor, or not while its images were taken.
  RunScaling(const ScaleSource& requested, const ImageSource& source, const ScaleParams& params);

  /// The same for a run whose source is gone: what it recorded is given.
  RunScaling(const ScaleSource& requested, VehicleTrack track, const Pinhole& pinhole,
             const std::optional<SE3>& T_vehicle_cam, const ScaleParams& params);

  /// The scale is measured, and wants each frame and keyframe while the run goes on.
  bool is_estimated() const { return requested_.is_estimated(); }
  /// After each frame, with the keyframes that have settled since the frame before. Nothing unless
  /// is_estimated().
  void add_frame(const FrameRecord& frame, const std::vector<KeyframeRecord>& settled);
  /// What the sensor recorded that the scale is measured by; empty where it needs none.
  const VehicleTrack& track() const { return track_; }
  /// Makes the finished run metric, if that was requested and is possible; else Run::scale.problem says
  /// why not.
  void apply(Run* run) const;

 private:
  ScaleSource requested_;
  ScaleParams params_;
  VehicleTrack track_;
  LiveScale live_;
};

}  // namespace edgevo
