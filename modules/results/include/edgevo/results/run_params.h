#pragma once
// All that --params and --set of `edgevo run` can name; params/default.yaml lists it.
#include "edgevo/odometry/odometry_params.h"
#include "edgevo/results/run_maps.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

struct RunParams {
  OdometryParams odometry;
  ScaleParams scale;
  MapParams map;

  void visit(ParamVisitor& v) {
    odometry.visit(v);
    { const auto g = v.group("scale"); scale.visit(v); }
    map.visit(v);
  }
};

}  // namespace edgevo
