#pragma once
#include <string>
#include <vector>

#include "edgevo/core/params.h"

namespace edgevo {

/// The detectors that edgevo knows, the default first: what edges.detector may be. A program need not offer
/// all of them (edge_detector.h).
std::vector<std::string> edge_detector_names();

/// Parameters of edge detection.
struct EdgeParams {
  /// one of edge_detector_names()
  std::string detector = "canny";
  /// path
  std::string model;
  /// path
  std::string folder;
  /// levels
  int levels = 4;
  /// levels
  int edge_levels = 2;
  /// [0.5, 0.99]
  double canny_percentile = 0.90;
  /// ratio
  double canny_low_ratio = 0.4;
  /// gray levels per pixel
  double min_gradient = 3.0;
  /// px
  int min_chain = 6;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
