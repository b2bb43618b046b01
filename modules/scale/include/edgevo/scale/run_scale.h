// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The metric scale of a finished run, frame by frame, and the run in metres.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/core/vehicle_track.h"
#include "edgevo/scale/live_scale.h"
#include "edgevo/scale/scale_estimate.h"
#include "edgevo/scale/scale_params.h"
#include "edgevo/scale/scale_source.h"

namespace edgevo {

/// The scale along a run, or the reason why there is none.
struct RunScale {
  /// One estimate for each of Run::frames; samples == 0: not measured there, copied from the nearest measured
  /// frame. Empty: nothing was measured.
  std::vector<ScaleEstimate> of_frame;
  /// Why there is no scale, and what to do; empty if there is one.
  std::string problem;
};

/// Measures the scale along each segment. `source` must be an estimated one; `track` is the track of its
/// sensor (empty for camera_height).
RunScale estimate_run_scale(const Run& run, const ScaleSource& source, const VehicleTrack& track,
                            const ScaleParams& params);

/// Converts every length of the run to metres. The path is rebuilt step by step, each step between two frames
/// with the scale measured there, so that scale drift is removed where it arose; keyframes move with their
/// frames, and inverse depths scale with their keyframes. Live poses are chained with the scale known when
/// each frame arrived (`live`, one for each frame); before the first estimate, with that first estimate,
/// which the record states. Fills Run::scale_source and Run::scale.
void make_metric(const RunScale& scale, const std::vector<std::optional<ScaleEstimate>>& live,
                 const ScaleSource& source, Run* run);

}  // namespace edgevo
