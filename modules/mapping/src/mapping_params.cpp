#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

void BootstrapParams::visit(ParamVisitor& v) {
  v.integer("max_corners", max_corners, 50, 10000, "corners followed from the first view");
  v.number("min_disparity", min_disparity, 0.001, 0.5,
           "median motion before the two views are tried, share of the image width");
  v.number("min_parallax_deg", min_parallax_deg, 0.05, 20,
           "median angle between the two rays of a point, degrees");
  v.number("ransac_px", ransac_px, 0.1, 10, "inlier threshold of the essential matrix, pixels");
  v.integer("min_tracks", min_tracks, 20, 10000, "corners that must survive");
  v.number("min_inlier_share", min_inlier_share, 0.1, 1,
           "of the corners, that must agree with the essential matrix");
  v.integer("max_frames", max_frames, 2, 10000, "after so many frames a new first view is taken");
  v.number("median_depth", median_depth, 1e-3, 1e6, "of the first map: sets the arbitrary unit of length");
}

void DepthFilterParams::visit(ParamVisitor& v) {
  v.integer("max_new_points", max_new_points, 10, 20000, "immature points made in a keyframe, at most");
  v.number("candidates_per_point", candidates_per_point, 0, 100,
           "immature points made for each that the window lacks");
  v.integer("cell_px", cell_px, 2, 200, "one new point in each cell of this size, pixels");
  v.number("prior_low", prior_low, 0.01, 1, "search range: times the smallest inverse depth seen nearby");
  v.number("prior_high", prior_high, 1, 100, "search range: times the largest inverse depth seen nearby");
  v.number("far_low", far_low, 1e-4, 1, "search range where none is near: times the median inverse depth");
  v.number("far_high", far_high, 1, 1000, "search range where none is near: times the median inverse depth");
  v.number("min_epipolar_cosine", min_epipolar_cosine, 0, 1,
           "edges more parallel to the epipolar line give no depth");
  v.number("min_normal_cosine", min_normal_cosine, -1, 1, "orientation gate, signed");
  v.number("max_edge_distance_px", max_edge_distance_px, 0.5, 5,
           "edges within this of the epipolar line are candidates, pixels");
  v.number("max_cost", max_cost, 0.01, 2, "patch cost of an acceptable match");
  v.number("max_cost_ratio", max_cost_ratio, 0.1, 1, "best over second best cost");
  v.number("sigma_edge_px", sigma_edge_px, 0.01, 5, "position noise of an edge along its normal, pixels");
  v.number("sigma_epipolar_px", sigma_epipolar_px, 0, 5, "position noise of the epipolar line, pixels");
  v.boolean("refine", refine, "one-dimensional refinement along the normal at the found crossing");
  v.integer("max_age_keyframes", max_age_keyframes, 1, 50, "immature points older than this are dropped");
  v.number("smoothing_weight", smoothing_weight, 0, 1,
           "pull of the neighbours along the edge on an inverse depth");
  v.number("smoothing_reach_px", smoothing_reach_px, 0, 100,
           "neighbours further along the edge do not count, pixels");
}

void WindowParams::visit(ParamVisitor& v) {
  v.integer("keyframes", keyframes, 3, 30, "size of the sliding window");
  v.integer("max_points", max_points, 50, 50000, "active points in the window");
  v.number("max_projected_sigma_px", max_projected_sigma_px, 0.1, 20,
           "an immature point joins below it, pixels");
  v.integer("min_matches", min_matches, 1, 10, "keyframes that must match a point before it joins");
  v.integer("activation_cell_px", activation_cell_px, 2, 200,
            "points are spread over cells of this size, pixels");
  v.text("solver", solver, {"schur", "ceres"}, "bundle adjustment");
  v.text("gauge", gauge, {"fixed", "prior"}, "two oldest poses fixed, or a marginalisation prior");
  v.integer("ba_iterations", ba_iterations, 1, 100, "at most, before the matches are updated");
  v.integer("ba_update_iterations", ba_update_iterations, 0, 100,
            "at most, after that; 0: the matches are not updated");
  v.number("ba_huber", ba_huber, 0.1, 100, "Huber width in sigmas");
  v.boolean("photometric", photometric, "image-gradient cost in the bundle adjustment (slower)");
  v.number("photometric_sigma", photometric_sigma, 0.01, 100,
           "deviation of a normalised patch difference in that cost");
  v.number("corner_sigma_px", corner_sigma_px, 0.05, 20,
           "standard deviation of a corner (group corners) in the bundle adjustment, pixels");
  v.integer("max_cloud_points", max_cloud_points, 50, 20000, "points that a frame is tracked against");
}

void CornerParams::visit(ParamVisitor& v) {
  v.number("max_inlier_share", max_inlier_share, 0, 1,
           "of a keyframe right after another one (large motion), below which corners give a motion "
           "hypothesis; 0: never");
  v.integer("max_corners", max_corners, 20, 10000, "corners followed from the last keyframe");
  v.integer("min_agreeing", min_agreeing, 8, 10000, "corners that must agree on one motion");
  v.number("min_agreeing_share", min_agreeing_share, 0.1, 1, "of those that could be followed");
  v.number("ransac_px", ransac_px, 0.1, 10, "inlier threshold of the essential matrix, pixels");
  v.number("min_parallax_deg", min_parallax_deg, 0, 20,
           "median angle between the two rays of a corner, degrees; with less they say nothing");
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
