#pragma once
// How likely each pixel of an image lies on an edge, by what was learned or computed before: the first half
// of the detectors that do not look at the gradient alone (paper, Sec. V: structured forests, HED). The
// second half, which pixels are then edges and where exactly they lie, is the image's own gradient's again
// (modules/detectors).
//
// It is taken from the image as the camera took it, once a frame: undistortion, rolling shutter and the
// coarser levels of the pyramid then move and halve it as they do the image, so that a probability from a
// file serves as well as one computed here, and a frame that is rectified anew costs no second look.
#include <string>

#include "edgevo/edges/plane.h"

namespace edgevo {

/// Tells the probability of an edge. One object a thread.
class EdgeProbability {
 public:
  virtual ~EdgeProbability() = default;
  /// Of the image's size, 0 (no edge) to 255; deterministic. `name`: of the frame (image_names.h). Throws
  /// InputError for an image that the model, or the folder, does not fit.
  virtual Plane<uint8_t> estimate(const ImageView<uint8_t>& gray, const std::string& name) = 0;
  /// What it is, for a journal: the model's file and a checksum of its bytes, or the folder.
  virtual std::string description() const = 0;
};

}  // namespace edgevo
