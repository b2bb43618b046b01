// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Probability that each pixel of an image lies on an edge, learned or precomputed: the first half of the
// detectors that do not use the gradient alone (paper, Sec. V: structured forests, HED). The second half, the
// selection of edge pixels and their exact positions, uses the gradient of the image again
// (modules/detectors).
//
// It is computed on the raw image, once per frame. Undistortion, rolling-shutter rectification and the
// coarser pyramid levels then transform it like the image. So probabilities from files work equally well, and
// a frame that is rectified again needs no second evaluation.
#include <string>

#include "edgevo/edges/plane.h"

namespace edgevo {

/// Estimates the probability of an edge. Use one object per thread.
class EdgeProbability {
 public:
  virtual ~EdgeProbability() = default;
  /// Returns a probability image of the size of `gray`, 0 (no edge) to 255; deterministic. `name` is that of
  /// the frame (image_names.h). Throws InputError for an image that does not fit the model or the folder.
  virtual Plane<uint8_t> estimate(const ImageView<uint8_t>& gray, const std::string& name) = 0;
  /// Description for records: the file of the model and a checksum of its bytes, or the folder.
  virtual std::string description() const = 0;
};

}  // namespace edgevo
