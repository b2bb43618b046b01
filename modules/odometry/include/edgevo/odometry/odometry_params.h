// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/association/association_params.h"
#include "edgevo/confidence/status_params.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edges/edge_params.h"
#include "edgevo/mapping/mapping_params.h"
#include "edgevo/self_calibration/self_calibration_params.h"
#include "edgevo/tracking/keyframe_params.h"

namespace edgevo {

/// Relocalisation after a loss, and precautions before one.
struct RecoveryParams {
  /// Frames.
  int max_frames = 10;
  /// Run a bootstrap next to a map that is still tracked, if the map is out of view and does not explain the
  /// images (src/map_coverage.h).
  bool bootstrap_out_of_view = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// Cross-checks of poses.
struct HealthParams {
  /// Follow corners next to the edges (features/feature_tracker.h).
  bool corners = true;
  /// When a motion is doubtful.
  ConfidenceParams confidence;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// All parameters of a run, group by group.
struct OdometryParams {
  /// Camera properties that the camera file does not contain.
  SelfCalibrationParams camera;
  /// Edge detection.
  EdgeParams edges;
  /// Tracking.
  AlignmentParams alignment;
  /// Tracking status; in the group `alignment`.
  StatusParams status;
  /// Matches between keyframes.
  AssociationParams association;
  /// Bootstrap, points and window.
  MappingParams mapping;
  /// Decision on keyframes; the group `keyframe` of `mapping`.
  KeyframeParams keyframe;
  /// Relocalisation.
  RecoveryParams recovery;
  /// Witnesses.
  HealthParams health;
  /// Map of lines.
  EdgeMapParams edge_map;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
