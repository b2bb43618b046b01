// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Thresholds of the tracking status, and what p_right reads: after a change of what a test makes of a
// measurement, fit the weights (src/trust_table.h) again (share/doc/numbers.md). A window, by how many frames
// something is averaged, is no threshold, and stays a constant of MotionConfidence.
#include "edgevo/core/params.h"

namespace edgevo {

/// Thresholds of the tracking status; keys of the group `alignment`. Read in src/frame_status.cpp only.
struct StatusParams {
  /// Share of the weighted points (alignment/pose_evidence.h).
  double degraded_share = 0.4;
  /// Share of the weighted points.
  double lost_share = 0.15;
  /// Points.
  int min_visible = 60;
  /// Edge pixels.
  int min_edges = 200;
  /// Points of known depth in the reference.
  int min_known_points = 200;
  /// Share of the window's points in view.
  double away_view_share = 0.15;
  /// Share of the points in view that are matched.
  double explained_share = 0.7;
  /// RMS along the normal.
  double explained_residual_px = 1.0;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// Step gate: when a tracked step is an outlier, none that a camera makes; its pose is refused.
struct StepGateParams {
  /// Length over the usual one (core/motion_history.h).
  double times = 10;
  /// Median depths a frame: a camera that stands still may start to move, and what is usual until then says
  /// nothing.
  double small = 0.002;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// What MotionConfidence reads; the group `health`.
struct ConfidenceParams {
  /// When a step is an outlier.
  StepGateParams step;
  /// Median depths per radian of turn, one standard deviation.
  double turn_error = 0.07;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
