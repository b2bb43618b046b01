// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/stage_timer.h"

namespace edgevo {

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::kEdges:
      return "edges";
    case Stage::kAlignment:
      return "alignment";
    case Stage::kCorners:
      return "corners";
    case Stage::kFeatureTracking:
      return "witness";
    case Stage::kBootstrap:
      return "bootstrap";
    case Stage::kDepthFilter:
      return "depth_filter";
    case Stage::kAssociation:
      return "association";
    case Stage::kActivation:
      return "activation";
    case Stage::kBundleAdjustment:
      return "bundle_adjustment";
    case Stage::kWindow:
      return "window";
    case Stage::kEdgeMap:
      return "edge_map";
    case Stage::kSelfCalibration:
      return "self_calibration";
  }
  return "";
}

}  // namespace edgevo
