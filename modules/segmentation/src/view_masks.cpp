// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/view_masks.h"

#include "border_mask.h"
#include "ego_mask.h"
#include "ego_mask_finder.h"

namespace edgevo {

struct ViewMasks::Impl {
  Rectification rectification;
  bool finds_ego_parts;
  BorderMask border;
  EgoMaskFinder fixed;
  EgoMask own;
  std::shared_ptr<const Plane<uint8_t>> ego_of_image;  // the newest one
};

ViewMasks::ViewMasks(const Rectification& rectification, const EdgeParams& params)
    : impl_(new Impl{rectification,
                     params.find_own_parts,
                     {},
                     {},
                     EgoMask(params.mask, rectification.camera().pinhole().width,
                             rectification.camera().pinhole().height),
                     {}}) {}
ViewMasks::~ViewMasks() = default;
ViewMasks::ViewMasks(ViewMasks&&) noexcept = default;

ImageMasks ViewMasks::add_image(const ImageView<uint8_t>& raw) {
  impl_->border.add(raw);
  impl_->ego_of_image = impl_->own.mask();
  return {impl_->border.mask(), impl_->ego_of_image};
}

bool ViewMasks::wants_edges() const { return impl_->finds_ego_parts; }

void ViewMasks::add_edges(const ImageEdges& edges, const Gradient& gradient, int level,
                          const ImageCorrection& correction) {
  if (!impl_->fixed.add(edges, gradient)) return;
  if (impl_->fixed.area())
    impl_->own.set_found(raw_area(*impl_->fixed.area(), level, impl_->rectification, correction));
  else
    impl_->own.clear_found();
}

// What was found in this image holds from the next one on.
bool ViewMasks::may_show_ego_part() const {
  return impl_->finds_ego_parts && (impl_->fixed.is_undecided() || impl_->own.mask() != impl_->ego_of_image);
}

StillCells ViewMasks::still_cells() const {
  return impl_->finds_ego_parts ? impl_->fixed.still_cells() : StillCells{};
}

}  // namespace edgevo
