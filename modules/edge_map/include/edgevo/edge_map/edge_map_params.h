// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the map of 3D edge lines.
struct EdgeMapParams {
  /// "off", "keyframes" or "full".
  std::string mode = "full";
  /// Images.
  int views = 8;
  /// Pixels.
  int step_px = 6;
  /// Images.
  int min_views = 3;
  /// Vertices.
  int min_vertices = 2;
  /// Share of the inverse depth.
  double max_relative_sigma = 0.03;

  /// Whether lines are made at all.
  bool is_on() const { return mode != "off"; }
  /// Whether lines of several keyframes are fused, so that each 3D edge is mapped once.
  bool is_fused() const { return mode == "full"; }
  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
