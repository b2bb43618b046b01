// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Pyramids of the images of one camera in their order, with the masks that they show.
#include <memory>

#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/segmentation/view_masks.h"

namespace edgevo::test {

struct MaskedBuilder {
  MaskedBuilder(const Rectification& rectification, const EdgeParams& params)
      : builder(rectification, params), masks(rectification, params) {}

  std::shared_ptr<const FramePyramid> build(const GrayImage& image, const ImageMotion& motion = {}) {
    return builder.build(image, motion, &masks);
  }

  PyramidBuilder builder;
  ViewMasks masks;
};

}  // namespace edgevo::test
