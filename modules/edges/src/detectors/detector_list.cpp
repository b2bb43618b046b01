// The detectors that there are. A new one: a file beside this one with a class that derives from EdgeDetector
// and a function that makes it, declared in detector_list.h and named here.
#include "detector_list.h"

#include "edgevo/core/error.h"

namespace edgevo {

const std::vector<EdgeDetectorKind>& edge_detector_kinds() {
  static const std::vector<EdgeDetectorKind> kKinds{
      {"canny", "hysteresis thresholds that follow the image", make_canny_detector},
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
  };
  return kKinds;
}

std::vector<std::string> edge_detector_names() {
  std::vector<std::string> names;
  for (const EdgeDetectorKind& kind : edge_detector_kinds()) names.emplace_back(kind.name);
  return names;
}

std::string edge_detector_help() {
  std::string help;
  for (const EdgeDetectorKind& kind : edge_detector_kinds())
    help += (help.empty() ? "" : ", ") + std::string(kind.name) + " (" + kind.what + ")";
  return help;
}

namespace {

const EdgeDetectorKind& kind_of(const EdgeParams& params) {
  for (const EdgeDetectorKind& kind : edge_detector_kinds())
    if (params.detector == kind.name) return kind;
  throw InputError("edges.detector", "unknown detector '" + params.detector + "'",
                   "did you mean '" + nearest_name(params.detector, edge_detector_names()) + "'?");
}

}  // namespace

std::unique_ptr<EdgeDetector> make_edge_detector(const EdgeParams& params) {
  return kind_of(params).make(params);
}

std::unique_ptr<EdgeProbability> make_edge_probability(const EdgeParams& params) {
  const auto make = kind_of(params).make_probability;
  return make ? make(params) : nullptr;
}

}  // namespace edgevo
