// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

void RecoveryParams::visit(ParamVisitor& v) {
  v.integer(
      kBasic, "max_frames", max_frames, 0, 1000,
      "frames in which relocalisation in the old map is tried after a loss, next to a new bootstrap; frames "
      "without edges do not count");
  v.boolean(kExperimental, "bootstrap_out_of_view", bootstrap_out_of_view,
            "bootstrap a new map while the old one is out of view and does not explain the images");
}

void HealthParams::visit(ParamVisitor& v) {
  v.boolean(kAdvanced, "corners", corners,
            "follow some corners through the images as a cross-check of poses; 0.4 ms a frame at 1241x376");
  confidence.visit(v);
}

void OdometryParams::visit(ParamVisitor& v) {
  {
    const auto g = v.group("camera");
    camera.visit(v);
  }
  {
    const auto g = v.group("edges");
    edges.visit(v);
  }
  {
    const auto g = v.group("alignment");
    alignment.visit_costs(v);
    status.visit(v);
    alignment.visit_heuristics(v);
  }
  {
    const auto g = v.group("association");
    association.visit(v);
  }
  {
    const auto g = v.group("mapping");
    mapping.visit(v);
    const auto in_mapping = v.group("keyframe");
    keyframe.visit(v);
  }
  {
    const auto g = v.group("recovery");
    recovery.visit(v);
  }
  {
    const auto g = v.group("health");
    health.visit(v);
  }
  {
    const auto g = v.group("edge_map");
    edge_map.visit(v);
  }
}

}  // namespace edgevo
