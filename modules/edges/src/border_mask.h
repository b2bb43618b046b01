#pragma once
// A static mask of the image border, found automatically: what no light reaches around an image circle, in the bars
// of a letterbox, or in corners that another program left empty when it undistorted. Its outline is fixed to the
// camera. Taken for edges of the scene, it says in every rotation that the camera has not rotated. Unlike all else it
// never leaves the view, so that in time the map holds more of it than of the scene, and follows it.
#include <memory>

#include "edgevo/core/image.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

class BorderMask {
 public:
  /// Narrows the mask to what is dark in this image as well: black areas of at least 4 % of the image that reach the
  /// border. Dark parts of the scene drop out as the camera moves; once nothing is left the search ends. All images
  /// have one size. Cost at 1241x376: about 1 ms while there is a mask.
  void add(const ImageView<uint8_t>& image);
  /// 255 in the masked border and a few pixels around it, else 0. Null where there is none, and for the first 20
  /// images, which cannot tell it from dark parts of the scene. The same object until it changes.
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
