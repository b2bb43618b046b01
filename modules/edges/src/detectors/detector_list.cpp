// The detectors that there are. A new one: a file beside this one with a class that derives from EdgeDetector
// and a function that makes it, declared in detector_list.h and named here.
#include "detector_list.h"

#include "edgevo/core/error.h"

namespace edgevo {

const std::vector<EdgeDetectorKind>& edge_detector_kinds() {
  static const std::vector<EdgeDetectorKind> kKinds{
      {"canny", "hysteresis thresholds that follow the image", make_canny_detector},
      {"edge_drawing", "OpenCV's EdgeDrawing with the same thresholds", make_edge_drawing_detector},
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

std::unique_ptr<EdgeDetector> make_edge_detector(const EdgeParams& params) {
  for (const EdgeDetectorKind& kind : edge_detector_kinds())
    if (params.detector == kind.name) return kind.make(params);
  throw InputError("edges.detector", "unknown detector '" + params.detector + "'",
                   "did you mean '" + nearest_name(params.detector, edge_detector_names()) + "'?");
}

}  // namespace edgevo
