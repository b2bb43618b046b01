// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edge_map/edge_trace.h"

namespace edgevo {

const std::string& to_string(EdgeStage stage) {
  static const std::vector<std::string> words{
      "edge too short",      "no crossing",  "too few views", "views without it", "does not move",
      "no depth chosen",     "along motion", "uncertain",     "piece too short",  "found",
      "explained by a line", "replaced",     "contradicted",  "not confirmed",    "kept"};
  return words[size_t(stage)];
}

}  // namespace edgevo
