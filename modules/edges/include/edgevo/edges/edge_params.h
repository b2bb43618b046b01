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
  std::string detector = "canny";  ///< one of edge_detector_names()
  std::string model;               ///< file of structured or network; empty: the one that comes with edgevo
  std::string folder;              ///< of precomputed
  int levels = 4;                  ///< pyramid levels of the image
  int edge_levels = 2;             ///< finest levels that get edges and a nearest-neighbour field
  double canny_percentile = 0.90;  ///< high threshold: this share of the pixels has a smaller gradient
  double canny_low_ratio = 0.4;    ///< low threshold over high threshold
  double min_gradient = 3.0;       ///< floor of the high threshold, gray levels per pixel
  int min_chain = 6;               ///< pixels
  int field_radius = 12;           ///< pixels

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

}  // namespace edgevo
