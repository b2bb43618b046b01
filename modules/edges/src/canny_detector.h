// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/edges/edge_detector.h"

namespace edgevo {

/// Makes the Canny detector.
std::unique_ptr<EdgeDetector> make_canny_detector(const EdgeParams& params);

}  // namespace edgevo
