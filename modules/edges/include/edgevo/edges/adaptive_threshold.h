#pragma once
// A threshold that follows the image, common to the detectors that look at the gradient.
#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// Sobel units: a percentile of the gradient (canny_percentile), but below its peak, which many pixels may
/// share (stripes, a chessboard), and not below the floor (min_gradient).
double high_threshold(const Plane<float>& magnitude, const EdgeParams& params);

}  // namespace edgevo
