// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the scale.
struct ScaleParams {
  /// Metres.
  double interval = 40;
  /// Relative.
  double max_sigma = 0.1;
  /// Camera heights.
  double ground_width = 0.8;
  /// Relative.
  double ground_sigma = 0.01;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v) {
    v.number(kBasic, "stretch", interval, 0.1, 10000,
             "metres of the path over which the scale is estimated; the interval slides along the run");
    v.number(kBasic, "max_sigma", max_sigma, 0.001, 1,
             "a relative standard deviation of the scale beyond this is no estimate");
    v.number(kAdvanced, "ground_width", ground_width, 0.1, 10,
             "camera_height: ground to each side of the camera's way, in camera heights");
    v.number(kAdvanced, "ground_sigma", ground_sigma, 0, 0.5,
             "camera_height: relative standard deviation of height and ground, added in square");
  }
};

}  // namespace edgevo
