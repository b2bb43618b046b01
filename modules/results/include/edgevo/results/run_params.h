// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// All parameters that --params and --set of `edgevo run` accept; `edgevo help parameters --all` lists them.
#include "edgevo/odometry/odometry_params.h"
#include "edgevo/places/place_params.h"
#include "edgevo/results/run_maps.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// Parameters of a run, by group.
struct RunParams {
  /// Parameters of the odometry: groups camera to edge_map.
  OdometryParams odometry;
  /// Parameters of recognising places.
  PlaceParams places;
  /// Parameters of the metric scale.
  ScaleParams scale;
  /// Parameters of the maps for planners: groups occupancy and grid.
  MapParams map;

  /// Declares names, ranges and help texts of the fields (core/params.h).
  void visit(ParamVisitor& v) {
    odometry.visit(v);
    {
      const auto g = v.group("places");
      places.visit(v);
    }
    {
      const auto g = v.group("scale");
      scale.visit(v);
    }
    map.visit(v);
  }
};

}  // namespace edgevo
