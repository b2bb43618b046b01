// SPDX-License-Identifier: BSD-3-Clause
// To add a detector: add a file next to this one with a class that derives from EdgeDetector and a factory,
// declare the factory in detector_list.h, add a line here, and add the name in edges/edge_params.cpp.
#include "edgevo/detectors/all_detectors.h"

#include "detector_list.h"

namespace edgevo {
namespace {

EdgeDetectorTable with_basic(std::initializer_list<EdgeDetectorKind> more) {
  EdgeDetectorTable table = basic_edge_detectors();
  table.insert(table.end(), more);
  return table;
}

}  // namespace

const EdgeDetectorTable& all_edge_detectors() {
  static const EdgeDetectorTable kTable = with_basic({
      {"edge_drawing", "OpenCV's EdgeDrawing with the same thresholds", make_edge_drawing_detector},
      {"structured", "learned structured forest", make_probable_detector, make_structured_probability},
      {"network", "learned small network, or any ONNX network", make_probable_detector,
       make_network_probability},
      {"precomputed", "probabilities from files written by edgevo edges", make_probable_detector,
       make_precomputed_probability},
      {"combined:structured", "those edges of Canny that structured selects", make_combined_detector,
       make_structured_probability},
      {"combined:network", "those edges of Canny that network selects", make_combined_detector,
       make_network_probability},
      {"combined:precomputed", "those edges of Canny that precomputed selects", make_combined_detector,
       make_precomputed_probability},
  });
  return kTable;
}

}  // namespace edgevo
