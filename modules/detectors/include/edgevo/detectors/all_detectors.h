// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The detectors of edgevo. All but Canny need OpenCV's dnn, ximgproc and imgcodecs, which the other modules
// of the method do not use.
#include "edgevo/edges/edge_detector.h"

namespace edgevo {

/// Table of all detectors, the default first, for OdometryOptions::detectors and PyramidBuilder.
const EdgeDetectorTable& all_edge_detectors();

}  // namespace edgevo
