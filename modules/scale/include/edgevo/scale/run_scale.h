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

/// The scale along a run, or why there is none.
struct RunScale {
  /// One for each of Run::frames; samples == 0: not measured there, taken over from the nearest frame that was. Empty: nothing was.
  std::vector<ScaleEstimate> of_frame;
  std::string problem;  ///< why there is none, and what to do; empty if there is one
};

/// Measures the scale along each segment. `source` is an estimated one; `track` is that of its sensor (empty for camera_height).
RunScale estimate_run_scale(const Run& run, const ScaleSource& source, const VehicleTrack& track, const ScaleParams& params);

/// Makes every length of the run metres. The path is chained again, each step between two frames with the scale measured there, so that
/// the drift of a monocular scale is taken out where it arose; keyframes go with their frames, and inverse depths with their keyframes.
/// Live poses are chained with what was known when each frame came (`live`, as many as frames); before anything was known, with the first value that became known,
/// which the record tells. Fills Run::scale_source and Run::scale.
void make_metric(const RunScale& scale, const std::vector<std::optional<ScaleEstimate>>& live, const ScaleSource& source, Run* run);

}  // namespace edgevo
