// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/view_masks.h"

#include <optional>

#include "border_mask.h"
#include "cell_labels.h"
#include "ego_mask.h"

namespace edgevo {

struct ViewMasks::Impl {
  Rectification rectification;
  bool finds_ego_parts;
  BorderMask border;
  CellLabels labels;
  EgoMask own;
  std::shared_ptr<const Plane<uint8_t>> ego_of_image;  // the newest one
  std::optional<ImageCorrection> excluded_with;        // lens for which what was given is excluded

  // What was given is no evidence.
  void exclude_given(const ImageEdges& edges, int level, const ImageCorrection& correction) {
    if (!own.given() || (excluded_with && correction.has_lens_of(*excluded_with))) return;
    excluded_with = correction;
    labels.exclude(level_area(*own.given(), {edges.width, edges.height, level}, rectification, correction));
  }

  RowShifts row_shifts(const ImageEdges& edges, int level, const ImageCorrection& correction,
                       const ImageMotion& motion) const {
    if (correction.readout_s == 0 || !motion.is_known()) return {};
    const Pinhole camera = rectification.target().at_level(level);
    std::vector<Eigen::Vector2f> shifts;
    for (int y = 0; y < edges.height; y += RowShifts::kStepPx)
      for (int x = 0; x < edges.width; x += RowShifts::kStepPx) {
        const Eigen::Vector2d here(x, y),
            from = add_rolling(rectification, row_time(correction), motion, camera.ray(here).head<2>());
        shifts.push_back((camera.project(from.homogeneous()) - here).cast<float>());
      }
    return {edges.width, std::move(shifts)};
  }
};

ViewMasks::ViewMasks(const Rectification& rectification, const EdgeParams& params)
    : impl_(new Impl{rectification,
                     params.find_own_parts,
                     {},
                     {},
                     EgoMask(params.mask, rectification.camera().pinhole().width,
                             rectification.camera().pinhole().height),
                     {},
                     {}}) {}
ViewMasks::~ViewMasks() = default;
ViewMasks::ViewMasks(ViewMasks&&) noexcept = default;

ImageMasks ViewMasks::add_image(const ImageView<uint8_t>& raw) {
  impl_->border.add(raw);
  impl_->ego_of_image = impl_->own.mask();
  return {impl_->border.mask(), impl_->ego_of_image};
}

bool ViewMasks::wants_edges() const { return impl_->finds_ego_parts; }

void ViewMasks::add_edges(const ImageEdges& edges, const Gradient& gradient, const Plane<uint8_t>& shown,
                          int level, const ImageCorrection& correction, const ImageMotion& motion) {
  impl_->exclude_given(edges, level, correction);
  if (!impl_->labels.add(edges, gradient, shown, impl_->row_shifts(edges, level, correction, motion))) return;
  if (impl_->labels.area())
    impl_->own.set_found(raw_area(*impl_->labels.area(), level, impl_->rectification, correction));
  else
    impl_->own.clear_found();
}

// What was found in this image holds from the next one on.
bool ViewMasks::may_show_ego_part() const {
  return impl_->finds_ego_parts && (impl_->labels.is_undecided() || impl_->own.mask() != impl_->ego_of_image);
}

StillCells ViewMasks::still_cells() const {
  return impl_->finds_ego_parts ? impl_->labels.still_cells() : StillCells{};
}

}  // namespace edgevo
