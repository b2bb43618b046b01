// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/edge_detector.h"

#include <algorithm>

#include "canny_detector.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

const EdgeDetectorKind& kind_of(const EdgeParams& params, const EdgeDetectorTable& table) {
  for (const EdgeDetectorKind& kind : table)
    if (params.detector == kind.name) return kind;
  const std::vector<std::string> names = edge_detector_names();
  if (std::find(names.begin(), names.end(), params.detector) != names.end())
    throw InputError("edges.detector",
                     "this program was built without the detector '" + params.detector + "'",
                     "link edgevo::detectors and pass all_edge_detectors(), or use canny");
  throw InputError("edges.detector", "unknown detector '" + params.detector + "'",
                   "did you mean '" + nearest_name(params.detector, names) + "'?");
}

}  // namespace

const EdgeDetectorTable& basic_edge_detectors() {
  static const EdgeDetectorTable kTable{{"canny", "adaptive hysteresis thresholds", make_canny_detector}};
  return kTable;
}

std::string edge_detector_help(const EdgeDetectorTable& table) {
  std::string help;
  for (const EdgeDetectorKind& kind : table)
    help += (help.empty() ? "" : ", ") + std::string(kind.name) + " (" + kind.what + ")";
  return help;
}

std::unique_ptr<EdgeDetector> make_edge_detector(const EdgeParams& params, const EdgeDetectorTable& table) {
  return kind_of(params, table).make(params);
}

std::unique_ptr<EdgeProbability> make_edge_probability(const EdgeParams& params,
                                                       const EdgeDetectorTable& table) {
  const auto make = kind_of(params, table).make_probability;
  return make ? make(params) : nullptr;
}

}  // namespace edgevo
