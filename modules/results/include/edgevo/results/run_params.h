#pragma once
// All that --params and --set of `edgevo run` can name; `edgevo help parameters --all` lists it.
#include "edgevo/odometry/odometry_params.h"
#include "edgevo/results/run_maps.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// The groups of parameters.
struct RunParams {
  OdometryParams odometry;  ///< camera to edge_map
  ScaleParams scale;        ///< the metre
  MapParams map;            ///< occupancy and grid

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v) {
    odometry.visit(v);
    {
      const auto g = v.group("scale");
      scale.visit(v);
    }
    map.visit(v);
  }
};

}  // namespace edgevo
