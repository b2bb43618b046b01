#pragma once
#include <string>

#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the lines of whole edges.
struct EdgeMapParams {
  /// "off", "keyframes" or "full"
  std::string mode = "full";
  /// images
  int views = 8;
  /// px
  int step_px = 3;
  /// images
  int min_views = 3;
  /// vertices
  int min_vertices = 4;
  /// share of the inverse depth
  double max_relative_sigma = 0.007;

  /// Lines are made at all.
  bool is_on() const { return mode != "off"; }
  /// Each 3D edge once.
  bool is_fused() const { return mode == "full"; }
  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
