// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edge_map/edge_map_params.h"

namespace edgevo {

void EdgeMapParams::visit(ParamVisitor& v) {
  v.text(kBasic, "mode", mode, {"off", "keyframes", "full"},
         "lines of edges: none, those of each keyframe, or each 3D edge once");
  v.integer(kAdvanced, "views", views, 2, 12,
            "other images that the edges of a keyframe are searched for in");
  v.integer(kAdvanced, "step_px", step_px, 1, 10,
            "pixels along an edge from one searched pixel to the next, at most");
  v.integer(kAdvanced, "min_views", min_views, 2, 12, "images that must show an edge where its depth says");
  v.integer(kAdvanced, "min_vertices", min_vertices, 2, 1000, "shorter lines are dropped");
  v.number(kAdvanced, "max_relative_sigma", max_relative_sigma, 0.0001, 1,
           "largest idepth_sigma/idepth of a vertex");
}

}  // namespace edgevo
