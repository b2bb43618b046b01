// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "edgevo/core/params.h"

namespace edgevo {

/// Valid values of edges.detector, the default first. A program need not offer all of them (edge_detector.h).
std::vector<std::string> edge_detector_names();

/// Parameters of edge detection.
struct EdgeParams {
  /// One of edge_detector_names().
  std::string detector = "canny";
  /// Path; may be empty.
  std::string model;
  /// Path; may be empty.
  std::string folder;
  /// Path; may be empty.
  std::string mask;
  /// Find and mask what is fixed to the camera (src/cell_labels.h).
  bool find_own_parts = true;
  /// Levels.
  int levels = 4;
  /// Levels.
  int edge_levels = 2;
  /// Share of the pixels, 0.5 to 0.99.
  double canny_percentile = 0.90;
  /// Ratio to the high threshold.
  double canny_low_ratio = 0.4;
  /// Gray levels per pixel.
  double min_gradient = 3.0;
  /// Pixels.
  int min_chain = 6;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
