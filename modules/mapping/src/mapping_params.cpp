// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

void BootstrapParams::visit(ParamVisitor& v) {
  v.number(kAdvanced, "min_disparity", min_disparity, 0.001, 0.5,
           "median motion from which the two views are tried, share of the image width");
  v.number(kAdvanced, "min_parallax_deg", min_parallax_deg, 0.05, 20,
           "smallest median angle between the two rays of a point after derotation, degrees");
  v.integer(kAdvanced, "max_frames", max_frames, 2, 10000, "frames after which a new first view is taken");
  v.boolean(kExperimental, "count_lost_corners", count_lost_corners,
            "count lost corners as moved further than the median");
}

void DepthFilterParams::visit(ParamVisitor& v) {
  v.integer(kAdvanced, "max_new_points", max_new_points, 10, 20000,
            "most immature points made in a keyframe");
  v.number(kAdvanced, "candidates_per_point", candidates_per_point, 0, 100,
           "immature points made for each point that the window lacks: some never get a depth, some leave "
           "the view before");
  v.integer(kAdvanced, "cell_px", cell_px, 2, 200, "size of the cells that get one new point each, pixels");
  v.number(kAdvanced, "max_cost", max_cost, 0.01, 2, "largest patch cost of a match");
  v.number(kAdvanced, "max_cost_ratio", max_cost_ratio, 0.1, 1,
           "largest ratio of the best cost to the second best more than 2.5 pixels away");
  v.number(kAdvanced, "sigma_edge_px", sigma_edge_px, 0.01, 5,
           "position noise of an edge along its normal, pixels");
  v.boolean(kAdvanced, "refine", refine, "refine a depth in one dimension along the normal at the crossing");
  v.number(kAdvanced, "smoothing_weight", smoothing_weight, 0, 1,
           "weight of the neighbours along the edge in an inverse depth");
  v.boolean(kExperimental, "use_neighbour_depths", use_neighbour_depths,
            "search the depth of a new point around known depths nearby; false: around the median");
}

void WindowParams::visit(ParamVisitor& v) {
  v.integer(kBasic, "keyframes", keyframes, 3, 30, "size of the sliding window: accuracy against time");
  v.integer(kBasic, "max_points", max_points, 50, 50000, "active points in the window");
  v.number(kAdvanced, "max_projected_sigma_px", max_projected_sigma_px, 0.1, 20,
           "standard deviation below which an immature point may become active, pixels");
  v.integer(kAdvanced, "min_matches", min_matches, 1, 10,
            "keyframes that must match a point before it becomes active");
  v.text(kAdvanced, "solver", solver, {"schur", "ceres"}, "solver of the bundle adjustment");
  v.integer(kAdvanced, "ba_iterations", ba_iterations, 1, 100,
            "most iterations before the matches are updated");
  v.integer(kAdvanced, "ba_update_iterations", ba_update_iterations, 0, 100,
            "most iterations after that; 0: do not update the matches");
  v.number(kAdvanced, "ba_huber", ba_huber, 0.1, 100, "Huber width in standard deviations");
  v.integer(kAdvanced, "max_cloud_points", max_cloud_points, 50, 20000,
            "points that a frame is tracked against");
  v.boolean(kExperimental, "use_tentative_points", use_tentative_points,
            "activate points by one depth and one match, until the next keyframe, where few points are seen");
  v.boolean(kExperimental, "track_immature_points", track_immature_points,
            "track against immature points, too, where few points of known depth are in view");
  v.boolean(kExperimental, "drop_outlier_matches", drop_outlier_matches,
            "drop matches many standard deviations off after the adjustment");
  v.boolean(kExperimental, "drop_missed_points", drop_missed_points,
            "drop points that several keyframes should have seen and did not");
  v.boolean(
      kExperimental, "pass_on_points", pass_on_points,
      "pass the points of a keyframe that leaves the window on to the newest one, with what is known of "
      "their depth");
  v.boolean(kExperimental, "adjust_corners", adjust_corners,
            "use pairs of corners (group corners) as residuals of the bundle adjustment");
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
