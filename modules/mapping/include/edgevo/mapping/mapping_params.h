#pragma once
#include <string>

#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the two-view bootstrap.
struct BootstrapParams {
  /// share of the image width
  double min_disparity = 0.016;
  /// degrees
  double min_parallax_deg = 0.7;
  /// frames
  int max_frames = 90;
  /// Corners that were lost count as moved further than the median (median_motion in src/corner_tracking.h).
  bool count_lost_corners = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// Parameters of new points and of their depth. Pixels: at full resolution.
struct DepthFilterParams {
  /// points
  int max_new_points = 1200;
  /// factor
  double candidates_per_point = 4;
  /// px
  int cell_px = 12;
  /// patch cost
  double max_cost = 0.30;
  /// ratio
  double max_cost_ratio = 0.75;
  /// px
  double sigma_edge_px = 0.5;
  /// on or off
  bool refine = true;
  /// [0, 1]
  double smoothing_weight = 0.3;
  /// A new point is searched around the depths known nearby, not around the median (idepth_prior.h).
  bool use_neighbour_depths = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// Parameters of the sliding window and its bundle adjustment.
struct WindowParams {
  /// keyframes
  int keyframes = 12;
  /// points
  int max_points = 2000;
  /// px
  double max_projected_sigma_px = 1.5;
  /// keyframes
  int min_matches = 2;
  /// a name that make_bundle_adjuster() knows
  std::string solver = "schur";
  /// iterations
  int ba_iterations = 4;
  /// iterations
  int ba_update_iterations = 4;
  /// standard deviations
  double ba_huber = 1.5;
  /// points
  int max_cloud_points = 1500;
  /// Where few points are seen, one depth and one match activate a point until the next keyframe.
  bool use_tentative_points = true;
  /// A frame is tracked against immature points, too, where few points of known depth are in view.
  bool track_immature_points = true;
  /// Matches many standard deviations off are dropped after the adjustment.
  bool drop_outlier_matches = true;
  /// Points that several keyframes should have seen and did not are dropped.
  bool drop_missed_points = true;
  /// Pairs of corners (group corners) are residuals of the adjustment.
  bool adjust_corners = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// When corners give a motion hypothesis: corner_motion.h.
struct CornerParams {
  /// [0, 1]
  double max_inlier_share = 0.7;
  /// corners
  int min_agreeing = 60;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// The groups of params/default.yaml under `mapping`, but for `keyframe` (odometry/keyframe_params.h).
struct MappingParams {
  BootstrapParams bootstrap;       ///< the first map of a segment
  DepthFilterParams depth_filter;  ///< new points
  WindowParams window;             ///< keyframes and their adjustment
  CornerParams corners;            ///< motion hypotheses from corners

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
