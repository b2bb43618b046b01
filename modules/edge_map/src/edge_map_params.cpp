#include "edgevo/edge_map/edge_map_params.h"

namespace edgevo {

void EdgeMapParams::visit(ParamVisitor& v) {
  v.text("mode", mode, {"off", "keyframes", "full"},
         "lines of edges: none, those of each keyframe, or each 3D edge once");
  v.integer("views", views, 2, 12, "other images that the edges of a keyframe are searched for in");
  v.integer("step_px", step_px, 1, 10, "pixels along an edge from one searched pixel to the next");
  v.integer("min_views", min_views, 2, 12, "images that must show an edge where its depth says");
  v.integer("min_vertices", min_vertices, 2, 1000, "shorter lines are left out");
  v.number("sigma_px", sigma_px, 0.01, 5, "position noise of an edge along its normal, pixels");
  v.number("max_relative_sigma", max_relative_sigma, 0.0001, 1, "largest idepth_sigma/idepth of a vertex");
  v.integer("fusion_keyframes", fusion_keyframes, 1, 1000,
            "a keyframe's lines are compared with those of so many after it");
}

}  // namespace edgevo
