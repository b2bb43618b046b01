#pragma once
// A static mask, found by itself. The part of the images that no light reaches: round an image circle, in the bars of a letterbox,
// in corners that another program left empty when it undistorted. Its outline is fixed to the camera. Taken for edges of the scene it
// says at every turn that the camera has not turned, and unlike all else it never leaves the view: in time the map holds more of it
// than of the scene, and follows it.
#include <memory>

#include "edgevo/core/image.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

class UnlitSurround {
 public:
  /// Narrows the surround to what is dark in this image as well: black areas of at least 4 % that reach the border. Dark parts of the scene go
  /// as the camera moves; once nothing is left nothing is looked for. All images have one size. Cost at 1241x376: about 1 ms while there is
  /// a surround.
  void add(const ImageView<uint8_t>& image);
  /// 255 in the surround and a few pixels around it, else 0; null where there is none, and for the first 20 images, which cannot tell it from
  /// dark parts of the scene. The same object until it changes.
  std::shared_ptr<const Plane<uint8_t>> mask() const;

 private:
  void find_areas();

  Plane<uint8_t> dark_;  // 255 where every image so far was dark
  int dark_pixels_ = 0;   // when areas were looked for
  int images_ = 0;
  bool is_gone_ = false;
  std::shared_ptr<const Plane<uint8_t>> areas_;
};

}  // namespace edgevo
