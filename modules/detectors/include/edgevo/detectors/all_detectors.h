#pragma once
// The detectors that come with edgevo. Those besides Canny bring OpenCV's dnn, ximgproc and imgcodecs, which
// the modules of the method do without.
#include "edgevo/edges/edge_detector.h"

namespace edgevo {

/// All of them, the default first: for OdometryOptions::detectors and PyramidBuilder.
const EdgeDetectorTable& all_edge_detectors();

}  // namespace edgevo
