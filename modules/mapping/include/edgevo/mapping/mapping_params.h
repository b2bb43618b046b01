// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/core/params.h"
#include "edgevo/features/corner_params.h"

namespace edgevo {

/// Parameters of the two-view bootstrap.
struct BootstrapParams {
  /// Share of the image width.
  double min_disparity = 0.016;
  /// Degrees.
  double min_parallax_deg = 0.7;
  /// Frames.
  int max_frames = 90;
  /// Count lost corners as moved further than the median (median_motion in features/corner_tracking.h).
  bool count_lost_corners = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// Parameters of new points and of their depth. Pixels refer to full resolution.
struct DepthFilterParams {
  /// Points.
  int max_new_points = 1200;
  /// Factor.
  double candidates_per_point = 4;
  /// Pixels.
  int cell_px = 12;
  /// Patch cost.
  double max_cost = 0.30;
  /// Ratio.
  double max_cost_ratio = 0.75;
  /// Pixels.
  double sigma_edge_px = 0.5;
  /// Refine the depth after the search.
  bool refine = true;
  /// 0 to 1.
  double smoothing_weight = 0.3;
  /// Search a new point around the depths known nearby, not around the median (idepth_prior.h).
  bool use_neighbour_depths = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// Parameters of the sliding window and its bundle adjustment.
struct WindowParams {
  /// Keyframes.
  int keyframes = 12;
  /// Points.
  int max_points = 2000;
  /// Pixels.
  double max_projected_sigma_px = 1.5;
  /// Keyframes.
  int min_matches = 2;
  /// Name that make_bundle_adjuster() knows.
  std::string solver = "schur";
  /// Iterations.
  int ba_iterations = 4;
  /// Iterations.
  int ba_update_iterations = 4;
  /// Standard deviations.
  double ba_huber = 1.5;
  /// Points.
  int max_cloud_points = 1500;
  /// Activate points by one depth and one match, until the next keyframe, where few points are seen.
  bool use_tentative_points = true;
  /// Track against immature points, too, where few points of known depth are in view.
  bool track_immature_points = true;
  /// Drop matches that are many standard deviations off after the adjustment.
  bool drop_outlier_matches = true;
  /// Drop points that several keyframes should have seen and did not.
  bool drop_missed_points = true;
  /// Pass the points of a keyframe that leaves on to the newest one.
  bool pass_on_points = true;
  /// Use pairs of corners (group corners) as residuals of the adjustment.
  bool adjust_corners = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// The groups of params/default.yaml under `mapping`, except `keyframe` (tracking/keyframe_params.h).
struct MappingParams {
  /// The first map of a segment.
  BootstrapParams bootstrap;
  /// New points.
  DepthFilterParams depth_filter;
  /// Keyframes and their adjustment.
  WindowParams window;
  /// Motion hypotheses from corners.
  CornerParams corners;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
