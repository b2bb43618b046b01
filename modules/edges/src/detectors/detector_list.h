#pragma once
// How each detector is made, for detector_list.cpp; each is defined in the file of its name.
#include "edgevo/edges/edge_detector.h"

namespace edgevo {

std::unique_ptr<EdgeDetector> make_canny_detector(const EdgeParams& params);
std::unique_ptr<EdgeDetector> make_edge_drawing_detector(const EdgeParams& params);

}  // namespace edgevo
