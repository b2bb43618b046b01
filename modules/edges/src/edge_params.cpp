// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/edge_params.h"

namespace edgevo {

std::vector<std::string> edge_detector_names() {
  return {"canny",       "edge_drawing",        "structured",       "network",
          "precomputed", "combined:structured", "combined:network", "combined:precomputed"};
}

void EdgeParams::visit(ParamVisitor& v) {
  v.text(kBasic, "detector", detector, edge_detector_names(), "edge detector");
  v.text(kAdvanced, "model", model, {},
         "forest in OpenCV's format, or .onnx with a .yaml of the same name; empty: model of edgevo");
  v.text(kAdvanced, "folder", folder, {},
         "folder of probability images NAME.png for images NAME.*, as written by `edgevo edges`");
  v.text(kAdvanced, "mask", mask, {}, "PNG of the shape of the images; what is black there gives no edges");
  v.boolean(kAdvanced, "find_own_parts", find_own_parts, "find and mask what is fixed to the camera");
  v.integer(kAdvanced, "levels", levels, 1, 8, "levels of the image pyramid");
  v.integer(kAdvanced, "edge_levels", edge_levels, 1, 4,
            "number of finest levels with edges and a nearest-neighbour field");
  v.number(kBasic, "canny_percentile", canny_percentile, 0.5, 0.99,
           "high threshold: this share of the pixels has a smaller gradient");
  v.number(kAdvanced, "canny_low_ratio", canny_low_ratio, 0.1, 1.0, "low threshold over high threshold");
  v.number(kBasic, "min_gradient", min_gradient, 0.5, 50,
           "floor of the high threshold, gray levels per pixel");
  v.integer(kAdvanced, "min_chain", min_chain, 2, 100, "shorter edges are dropped, pixels");
}

}  // namespace edgevo
