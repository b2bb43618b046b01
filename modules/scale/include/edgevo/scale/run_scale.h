// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The metric scale of a finished run, frame by frame, and the run in metres.
#include <map>
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
  /// One estimate for each of Run::frames; samples == 0: not measured there, but by what lies around it.
  /// Empty: nothing was measured.
  std::vector<ScaleEstimate> of_frame;
  /// What did not count.
  std::vector<ScaleFault> faults;
  /// Why there is no scale, and what to do; empty if there is one.
  std::string problem;
  /// Clocks that were found to be off, by source.
  std::map<std::string, ClockOffset> clock_offsets;
};

/// Measures the scale along the run by all sources together, which must be estimated ones; `tracks` are those
/// of their sensors. A source that contradicts the rest does not count there, and is named. One whose clock
/// is off counts with corrected stamps.
RunScale estimate_run_scale(const Run& run, const ScaleSources& sources, const VehicleTracks& tracks,
                            const ScaleParams& params);

/// Converts every length of the run to metres. The path is rebuilt step by step, each step between two frames
/// with the scale measured there, so that scale drift is removed where it arose; keyframes move with their
/// frames, and inverse depths scale with their keyframes. Live poses are chained with the scale known when
/// each frame arrived (`live`, one for each frame); before the first estimate, with that first estimate,
/// which the record states. Fills Run::scale_source and Run::scale.
void make_metric(const RunScale& scale, const std::vector<std::optional<ScaleEstimate>>& live,
                 const ScaleSources& sources, Run* run);

}  // namespace edgevo
