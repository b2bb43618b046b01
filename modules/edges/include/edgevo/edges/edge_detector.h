#pragma once
// Edge detectors behind one interface: each marks edge pixels in a mask; thinning, sub-pixel positions and linking are common to
// all (edge_extraction.h).
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/params.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

struct EdgeParams {
  std::string detector = "canny";
  int levels = 4;                ///< pyramid levels of the image
  int edge_levels = 2;           ///< finest levels that get edges and a nearest-neighbour field
  double canny_percentile = 0.90;
  double canny_low_ratio = 0.4;
  double min_gradient = 3.0;     ///< gray levels per pixel
  int min_chain = 6;             ///< pixels
  int field_radius = 12;         ///< pixels

  void visit(ParamVisitor& v);
};

class EdgeDetector {
 public:
  virtual ~EdgeDetector() = default;
  /// Mask of the image's size, nonzero at edge pixels (one or two pixels thick).
  virtual Plane<uint8_t> detect(const ImageView<uint8_t>& gray, const Gradient& gradient) = 0;
};

/// "canny": hysteresis thresholds follow the image (percentile of the gradient magnitude), so that the number of edge pixels stays
/// steady when exposure moves. "edge_drawing": OpenCV's EdgeDrawing with the same adaptive threshold.
/// Throws InputError for an unknown name.
std::unique_ptr<EdgeDetector> make_edge_detector(const EdgeParams& params);
std::vector<std::string> edge_detector_names();

}  // namespace edgevo
