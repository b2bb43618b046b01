// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the images of one camera show from one to the next without a pose: where no light reaches them, what
// is fixed to the camera, and what stands still.
#include <memory>

#include "edgevo/core/rectification.h"
#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/view_observer.h"
#include "edgevo/segmentation/still_cells.h"

namespace edgevo {

/// Masks for the images of one camera, in their order; for PyramidBuilder::build() of each. Areas that no
/// image so far has lit (a letterbox) are masked, and parts that were given (edges.mask), or found to be
/// fixed to the camera (edges.find_own_parts).
class ViewMasks final : public ViewObserver {
 public:
  /// Throws InputError for a mask file that cannot be used.
  ViewMasks(const Rectification& rectification, const EdgeParams& params);
  ~ViewMasks() override;
  ViewMasks(ViewMasks&&) noexcept;

  ImageMasks add_image(const ImageView<uint8_t>& raw) override;
  bool wants_edges() const override;
  void add_edges(const ImageEdges& edges, const Gradient& gradient, const Plane<uint8_t>& shown, int level,
                 const ImageCorrection& correction, const ImageMotion& motion) override;

  /// Whether a part of the newest view may be fixed to the camera, which the next images will show.
  bool may_show_ego_part() const;
  /// What stands still in the newest view, before a camera that seems to stand; else empty.
  StillCells still_cells() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
