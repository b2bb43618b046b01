// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/confidence/status_params.h"
#include "edgevo/edges/edge_params.h"
#include "edgevo/features/corner_params.h"
#include "edgevo/tracking/keyframe_params.h"

namespace edgevo {

/// What tracking needs of the parameters of a run.
struct TrackingParams {
  /// Edge detection.
  EdgeParams edges;
  /// A frame against the reference.
  AlignmentParams alignment;
  /// Status of a pose.
  StatusParams status;
  /// When a step is an outlier.
  StepGateParams step;
  /// Motion hypotheses from corners.
  CornerParams corners;
  /// Decision on keyframes.
  KeyframeParams keyframe;
  /// Whether a map that is out of view and explains nothing counts as such (map_coverage.h).
  bool bootstrap_out_of_view = true;
  /// Whether keyframes carry the motion of their rows (SelfCalibrationParams::knows_rolling).
  bool rectify_keyframes = false;
};

}  // namespace edgevo
