#pragma once
#include <string>

#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the two-view bootstrap. Pixels: at full resolution.
struct BootstrapParams {
  int max_corners = 1200;         ///< tracked from the first view
  double min_disparity = 0.016;   ///< median, share of the image width
  double min_parallax_deg = 0.7;  ///< median, rotation taken out
  double ransac_px = 0.7;         ///< inlier threshold of the essential matrix
  int min_tracks = 80;            ///< corners that must survive
  double min_inlier_share = 0.6;  ///< of the corners, that must agree with the essential matrix
  int max_frames = 90;            ///< then a new first view is taken
  double median_depth = 10.0;     ///< of the first map; this sets the arbitrary unit

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

/// Parameters of new points and of their depth.
struct DepthFilterParams {
  int max_new_points = 1200;  ///< a keyframe
  double candidates_per_point =
      4;  ///< new points for each that the window lacks; some never get a depth, some leave the view before
  int cell_px = 12;                          ///< one new point a cell
  double prior_low = 0.4, prior_high = 2.5;  ///< search range around the depths seen nearby
  double far_low = 0.02, far_high = 8.0;     ///< where none is near: times the median inverse depth
  double min_epipolar_cosine = 0.25;         ///< edges more parallel to the epipolar line give no depth
  double min_normal_cosine = 0.7;            ///< orientation gate, signed
  double max_edge_distance_px = 1.5;         ///< from the epipolar line to an edge that is a candidate
  double max_cost = 0.30;                    ///< patch cost of an acceptable match
  double max_cost_ratio = 0.75;              ///< best over second best further than 2.5 px away
  /// position noise of an edge along its normal, and of the epipolar line
  double sigma_edge_px = 0.5, sigma_epipolar_px = 0.3;
  bool refine = true;              ///< one-dimensional refinement along the normal at the found crossing
  int max_age_keyframes = 4;       ///< immature points older than this are dropped
  double smoothing_weight = 0.3;   ///< pull of the neighbours along the edge, [0, 1]
  double smoothing_reach_px = 14;  ///< neighbours further along the edge do not count

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

/// Parameters of the sliding window and its bundle adjustment.
struct WindowParams {
  int keyframes = 12;                   ///< in the window
  int max_points = 2000;                ///< active, in the window
  double max_projected_sigma_px = 1.5;  ///< an immature point joins below it
  int min_matches = 2;                  ///< keyframes that must match a point before it joins
  int activation_cell_px = 14;          ///< points are spread over cells of this size
  std::string solver = "schur";         ///< a name that make_bundle_adjuster() knows
  std::string gauge = "prior";          ///< "fixed": two oldest poses; "prior": marginalisation prior
  int ba_iterations = 4;                ///< before the matches are updated
  int ba_update_iterations = 4;         ///< after that
  double ba_huber = 1.5;                ///< Huber width in sigmas
  bool photometric = false;             ///< image-gradient cost in the BA, Eq. (photometricerror)
  double photometric_sigma = 0.5;       ///< of a normalised patch difference, in deviations
  double corner_sigma_px = 0.5;         ///< one standard deviation of a corner
  int max_cloud_points = 1500;          ///< that a frame is tracked against

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

/// When corners give a motion hypothesis: corner_motion.h.
struct CornerParams {
  double max_inlier_share = 0.7;    ///< of a keyframe right after another one: large motion; below it corners
                                    ///< give a hypothesis. 0: never
  int max_corners = 450;            ///< tracked from the last keyframe
  int min_agreeing = 60;            ///< inliers
  double min_agreeing_share = 0.7;  ///< of the corners that could be tracked
  double ransac_px = 1.0;           ///< inlier threshold of the essential matrix
  double min_parallax_deg = 0.3;    ///< median over the inliers, rotation taken out

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

/// The groups of params/default.yaml under `mapping`, but for `keyframe` (odometry/keyframe_params.h).
struct MappingParams {
  BootstrapParams bootstrap;       ///< the first map of a segment
  DepthFilterParams depth_filter;  ///< new points
  WindowParams window;             ///< keyframes and their adjustment
  CornerParams corners;            ///< motion hypotheses from corners

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

}  // namespace edgevo
