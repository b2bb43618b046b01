#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the scale.
struct ScaleParams {
  double stretch = 40;          ///< metres of the way over which the scale is estimated; it slides along
  double max_sigma = 0.1;       ///< a relative standard deviation beyond this is no estimate
  int min_ground_points = 20;   ///< on the stretch
  double ground_width = 0.8;    ///< ground is looked for this far to each side of the camera's way, camera heights
  double ground_sigma = 0.01;   ///< how well a road is flat and a camera's height known, relative

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v) {
    v.number("stretch", stretch, 0.1, 10000, "metres of the way over which the scale is estimated; it slides along the run");
    v.number("max_sigma", max_sigma, 0.001, 1, "a relative standard deviation of the scale beyond this is no estimate");
    v.integer("min_ground_points", min_ground_points, 5, 10000, "camera_height: points of the ground that a stretch must have");
    v.number("ground_width", ground_width, 0.1, 10, "camera_height: ground to each side of the camera's way, in camera heights");
    v.number("ground_sigma", ground_sigma, 0, 0.5, "camera_height: relative deviation of height and ground, added in square");
  }
};

}  // namespace edgevo
