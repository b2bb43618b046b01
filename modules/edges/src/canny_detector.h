#pragma once
#include "edgevo/edges/edge_detector.h"

namespace edgevo {

std::unique_ptr<EdgeDetector> make_canny_detector(const EdgeParams& params);

}  // namespace edgevo
