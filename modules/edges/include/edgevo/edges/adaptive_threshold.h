// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Adaptive threshold, common to the detectors that use the gradient.
#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// High threshold, Sobel units: a percentile of the gradient (canny_percentile), but below its maximum, which
/// many pixels may share (stripes, a chessboard), and not below the floor (min_gradient).
double high_threshold(const Plane<float>& magnitude, const EdgeParams& params);

}  // namespace edgevo
