// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Automatic static mask of the unlit image border: around an image circle, in the bars of a letterbox, or in
// corners that another program left empty when it undistorted. Its outline is fixed to the camera. Taken for
// edges of the scene, it would contradict every rotation of the camera; and because it never leaves the view,
// in time the map would contain more of it than of the scene, and follow it.
#include <memory>

#include "edgevo/core/image.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Finds the unlit border of the images of one camera.
class BorderMask {
 public:
  /// Restricts the mask to areas that are dark in this image too: black areas of at least 4 % of the image
  /// that touch the border. Dark parts of the scene drop out as the camera moves; the search ends once
  /// nothing remains. All images have the same size. Cost at 1241x376: about 1 ms while there is a mask.
  void add(const ImageView<uint8_t>& image);
  /// Mask, 255 in the border and a few pixels around it, else 0. Null if there is none, and for the first 20
  /// images, in which it cannot be distinguished from dark parts of the scene. The same object until it
  /// changes.
  std::shared_ptr<const Plane<uint8_t>> mask() const;

 private:
  Plane<uint8_t> black_;  // 255 in areas that every image so far has shown black
  int images_ = 0;
  int black_pixels_ = 0;  // at the last search of areas
  std::shared_ptr<const Plane<uint8_t>> area_;
};

}  // namespace edgevo
