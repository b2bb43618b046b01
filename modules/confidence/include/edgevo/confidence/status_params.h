// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Thresholds of the tracking status, and of p_right, of which all but the step gate were set by hand on the
// 54 runs that the weights (src/trust_table.h) were fitted to: after a change of what a test makes of a
// measurement, fit the weights again (share/doc/numbers.md). A window, by how many frames something is
// averaged, is no threshold, and stays a constant of MotionConfidence.
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
  /// Share of the median depth; radians.
  double weak_sigma = 0.01;
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

/// Step gate: when a step is an outlier, none that a camera makes.
struct StepGateParams {
  /// Length over the usual one (core/motion_history.h).
  double times = 10;
  /// Median depths a frame: a camera that stands still may start to move, and what is usual until then says
  /// nothing.
  double small = 0.002;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// From a measurement to an inconsistency (src/consistency_tests.h).
struct ConsistencyParams {
  /// Standard deviations of the corners' length.
  double corner_length_sigmas = 2.5;
  /// Standard deviation of the logarithm of the corners' scale.
  double max_scale_sigma = 0.3;
  /// Share of the corners.
  double contradicting_share = 0.2;
  /// Standard deviations of the focal length.
  double focal_sigmas = 2;
  /// Corners.
  int min_corners = 15;
  /// Standard deviation of the corners' motion, as a share of its length: it checks the motion up to the
  /// first, and not from the second on.
  double sure_motion_sigma = 0.1, vague_motion_sigma = 0.25;
  /// Median depths in ten frames.
  double short_motion = 0.02;
  /// Standard deviation of a pose: median depths, radians.
  double no_information_sigma = 0.1;
  /// Radians in ten frames.
  double min_turn_rad = 0.05;
  /// Median depths per radian of turn.
  double first_turn_error = 0.07;
  /// Pixels, RMS.
  double usual_residual_px = 0.6;
  /// Inlier shares of 0 and of 1.
  double many_inliers = 0.7, few_inliers = 0.4;
  /// Points of known depth.
  double many_points = 300;
  /// Share of the map in view.
  double wide_view_share = 0.3;
  /// Blur of edges (edges/image_quality.h), and how much more is an inconsistency of 1.
  double sharp_blur = 0.5, blur_range = 0.1;
  /// Share of the pixels.
  double saturated_range = 0.3;
  /// An inconsistency.
  double max_unproven = 1;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// When one test alone decides that a motion is doubtful.
struct VetoParams {
  /// Probability, below kDoubtfulBelow.
  double p_right = 0.1;
  /// Inconsistencies.
  double motion = 1.6, focal_length = 1;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// What MotionConfidence reads; the group `health`.
struct ConfidenceParams {
  /// When a step is an outlier.
  StepGateParams step;
  /// When one test decides.
  VetoParams veto;
  /// The tests.
  ConsistencyParams consistency;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
