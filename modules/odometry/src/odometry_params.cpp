#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

void RecoveryParams::visit(ParamVisitor& v) {
  v.integer("max_frames", max_frames, 0, 1000,
            "relocalisation in the old map is tried in so many frames after a loss; those that show nothing "
            "do not count");
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
    alignment.visit(v);
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
    const auto g = v.group("edge_map");
    edge_map.visit(v);
  }
}

}  // namespace edgevo
