#include "edgevo/edges/edge_params.h"

namespace edgevo {

std::vector<std::string> edge_detector_names() {
  return {"canny",       "edge_drawing",        "structured",       "network",
          "precomputed", "combined:structured", "combined:network", "combined:precomputed"};
}

void EdgeParams::visit(ParamVisitor& v) {
  v.text(kBasic, "detector", detector, edge_detector_names(), "what marks edge pixels");
  v.text(kAdvanced, "model", model, {},
         "structured: forest in OpenCV's format; network: .onnx with its .yaml beside it; empty: the one "
         "that comes with edgevo");
  v.text(kAdvanced, "folder", folder, {},
         "precomputed: folder of probability images, NAME.png for the image NAME.*, as `edgevo edges` writes "
         "it");
  v.integer(kAdvanced, "levels", levels, 1, 8, "levels of the image pyramid");
  v.integer(kAdvanced, "edge_levels", edge_levels, 1, 4,
            "finest levels that get edges and a nearest-neighbour field");
  v.number(kBasic, "canny_percentile", canny_percentile, 0.5, 0.99,
           "high threshold: this share of the pixels has a smaller gradient");
  v.number(kAdvanced, "canny_low_ratio", canny_low_ratio, 0.1, 1.0, "low threshold over high threshold");
  v.number(kBasic, "min_gradient", min_gradient, 0.5, 50,
           "floor of the high threshold, gray levels per pixel");
  v.integer(kAdvanced, "min_chain", min_chain, 2, 100, "shorter edges are dropped, pixels");
}

}  // namespace edgevo
