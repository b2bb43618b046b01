#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the scale.
struct ScaleParams {
  /// m
  double stretch = 40;
  /// relative
  double max_sigma = 0.1;
  /// camera heights
  double ground_width = 0.8;
  /// relative
  double ground_sigma = 0.01;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v) {
    v.number(kBasic, "stretch", stretch, 0.1, 10000,
             "metres of the way over which the scale is estimated; it slides along the run");
    v.number(kBasic, "max_sigma", max_sigma, 0.001, 1,
             "a relative standard deviation of the scale beyond this is no estimate");
    v.number(kAdvanced, "ground_width", ground_width, 0.1, 10,
             "camera_height: ground to each side of the camera's way, in camera heights");
    v.number(kAdvanced, "ground_sigma", ground_sigma, 0, 0.5,
             "camera_height: relative standard deviation of height and ground, added in square");
  }
};

}  // namespace edgevo
