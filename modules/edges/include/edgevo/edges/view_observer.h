// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is learnt about a view from one image to the next, as the builder of pyramids needs it. The builder
// itself keeps no memory: an image with the same masks has the same edges.
#include <memory>

#include "edgevo/core/image.h"
#include "edgevo/edges/gradient.h"
#include "edgevo/edges/image_correction.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/image_motion.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Masks of a raw image: 255 where no edges are extracted, else 0; null if there is no such area.
struct ImageMasks {
  /// Where no light ever reaches the image.
  std::shared_ptr<const Plane<uint8_t>> border;
  /// On parts that are fixed to the camera.
  std::shared_ptr<const Plane<uint8_t>> ego;
};

/// Follows the images of one camera while their pyramids are built (segmentation/view_masks.h).
class ViewObserver {
 public:
  virtual ~ViewObserver() = default;
  /// Adds the next image, raw and with 8 bits; returns its masks.
  virtual ImageMasks add_image(const ImageView<uint8_t>& raw) = 0;
  /// Whether add_edges() is wanted.
  virtual bool wants_edges() const = 0;
  /// Adds the edges of that image on the coarsest level with edges, number `level`: also those under the ego
  /// mask, but not those of its border or of rows of an older one: there `shown`, of that level's size, is 0;
  /// empty if there is no such area. `correction`, `motion`: for which the image was rectified.
  virtual void add_edges(const ImageEdges& edges, const Gradient& gradient, const Plane<uint8_t>& shown,
                         int level, const ImageCorrection& correction, const ImageMotion& motion) = 0;
};

}  // namespace edgevo
