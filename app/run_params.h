#pragma once
// All that --params and --set of `edgevo run` can name; params/default.yaml lists it.
#include "edgevo/occupancy/occupancy_params.h"
#include "edgevo/odometry/odometry_params.h"

namespace edgevo::app {

struct RunParams {
  OdometryParams odometry;
  OccupancyParams occupancy;

  void visit(ParamVisitor& v) {
    odometry.visit(v);
    const auto g = v.group("occupancy");
    occupancy.visit(v);
  }
};

}  // namespace edgevo::app
