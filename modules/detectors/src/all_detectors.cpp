// A new detector: a file next to this one with a class that derives from EdgeDetector and a function that
// makes it, declared in detector_list.h and named here; its name also in edges/edge_params.cpp.
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
      {"structured", "structured forests, learned", make_probable_detector, make_structured_probability},
      {"network", "a small network, learned, or any in ONNX", make_probable_detector,
       make_network_probability},
      {"precomputed", "probabilities from files, see edgevo edges", make_probable_detector,
       make_precomputed_probability},
      {"combined:structured", "of Canny's edges those that structured would choose", make_combined_detector,
       make_structured_probability},
      {"combined:network", "the same by network", make_combined_detector, make_network_probability},
      {"combined:precomputed", "the same by precomputed", make_combined_detector,
       make_precomputed_probability},
  });
  return kTable;
}

}  // namespace edgevo
