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
  /// Points in view, or edge pixels of an image.
  int min_visible = 60;
  /// Share of the window's points in view.
  double away_view_share = 0.15;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// Step gate: when a tracked step is an outlier, none that a camera makes; its pose is refused.
struct StepGateParams {
  /// Length over the usual one (core/motion_history.h).
  double times = 10;

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
