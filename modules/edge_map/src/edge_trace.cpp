#include "edgevo/edge_map/edge_trace.h"

namespace edgevo {

const std::string& to_string(EdgeFate fate) {
  static const std::vector<std::string> words{
      "edge too short",  "no crossing",  "too few views", "views without it",  "does not move",
      "no depth chosen", "along motion", "uncertain",     "stretch too short", "found",
      "told by a line",  "replaced",     "contradicted",  "not confirmed",     "kept"};
  return words[size_t(fate)];
}

}  // namespace edgevo
