#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

void BootstrapParams::visit(ParamVisitor& v) {
  v.number(kAdvanced, "min_disparity", min_disparity, 0.001, 0.5,
           "median motion before the two views are tried, share of the image width");
  v.number(kAdvanced, "min_parallax_deg", min_parallax_deg, 0.05, 20,
           "median angle between the two rays of a point, rotation taken out, degrees");
  v.integer(kAdvanced, "max_frames", max_frames, 2, 10000, "after so many frames a new first view is taken");
  v.boolean(kExperimental, "count_lost_corners", count_lost_corners,
            "corners that were lost count as moved further than the median");
}

void DepthFilterParams::visit(ParamVisitor& v) {
  v.integer(kAdvanced, "max_new_points", max_new_points, 10, 20000,
            "immature points made in a keyframe, at most");
  v.number(kAdvanced, "candidates_per_point", candidates_per_point, 0, 100,
           "immature points made for each that the window lacks: some never get a depth, some leave the view "
           "before");
  v.integer(kAdvanced, "cell_px", cell_px, 2, 200, "one new point in each cell of this size, pixels");
  v.number(kAdvanced, "max_cost", max_cost, 0.01, 2, "patch cost of an acceptable match");
  v.number(kAdvanced, "max_cost_ratio", max_cost_ratio, 0.1, 1,
           "best cost over the second best, further than 2.5 pixels away");
  v.number(kAdvanced, "sigma_edge_px", sigma_edge_px, 0.01, 5,
           "position noise of an edge along its normal, pixels");
  v.boolean(kAdvanced, "refine", refine, "one-dimensional refinement along the normal at the found crossing");
  v.number(kAdvanced, "smoothing_weight", smoothing_weight, 0, 1,
           "pull of the neighbours along the edge on an inverse depth");
  v.boolean(kExperimental, "use_neighbour_depths", use_neighbour_depths,
            "a new point is searched around the depths known nearby; false: around the median");
}

void WindowParams::visit(ParamVisitor& v) {
  v.integer(kBasic, "keyframes", keyframes, 3, 30, "size of the sliding window: accuracy against time");
  v.integer(kBasic, "max_points", max_points, 50, 50000, "active points in the window");
  v.number(kAdvanced, "max_projected_sigma_px", max_projected_sigma_px, 0.1, 20,
           "an immature point joins below it, pixels");
  v.integer(kAdvanced, "min_matches", min_matches, 1, 10,
            "keyframes that must match a point before it joins");
  v.text(kAdvanced, "solver", solver, {"schur", "ceres"}, "bundle adjustment");
  v.integer(kAdvanced, "ba_iterations", ba_iterations, 1, 100, "at most, before the matches are updated");
  v.integer(kAdvanced, "ba_update_iterations", ba_update_iterations, 0, 100,
            "at most, after that; 0: the matches are not updated");
  v.number(kAdvanced, "ba_huber", ba_huber, 0.1, 100, "Huber width in standard deviations");
  v.integer(kAdvanced, "max_cloud_points", max_cloud_points, 50, 20000,
            "points that a frame is tracked against");
  v.boolean(kExperimental, "use_tentative_points", use_tentative_points,
            "where few points are seen, one depth and one match activate a point until the next keyframe");
  v.boolean(kExperimental, "track_immature_points", track_immature_points,
            "track against immature points, too, where few points of known depth are in view");
  v.boolean(kExperimental, "drop_outlier_matches", drop_outlier_matches,
            "drop matches many standard deviations off after the adjustment");
  v.boolean(kExperimental, "drop_missed_points", drop_missed_points,
            "drop points that several keyframes should have seen and did not");
  v.boolean(kExperimental, "adjust_corners", adjust_corners,
            "pairs of corners (group corners) are residuals of the bundle adjustment");
}

void CornerParams::visit(ParamVisitor& v) {
  v.number(kAdvanced, "max_inlier_share", max_inlier_share, 0, 1,
           "of a keyframe right after another one (large motion), below which corners give a motion "
           "hypothesis; 0: never");
  v.integer(kAdvanced, "min_agreeing", min_agreeing, 8, 10000, "corners that must agree on one motion");
}

void MappingParams::visit(ParamVisitor& v) {
  {
    const auto g = v.group("bootstrap");
    bootstrap.visit(v);
  }
  {
    const auto g = v.group("depth_filter");
    depth_filter.visit(v);
  }
  {
    const auto g = v.group("window");
    window.visit(v);
  }
  {
    const auto g = v.group("corners");
    corners.visit(v);
  }
}

}  // namespace edgevo
