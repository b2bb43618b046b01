// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a patch of one image lies in the next (Lucas-Kanade, from coarse to fine, on the pyramids of the
// frames). Only what the patches cover is read: they cover a tenth of the image.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// An image as patches are followed in it: some levels of a frame, brought to the usual mean and contrast, so
/// that exposure does not matter.
class FlowImage {
 public:
  /// Keeps the frame. `level`: the finest of its levels to use; coarser ones than it has are made.
  FlowImage(std::shared_ptr<const FramePyramid> frame, int level);

  /// Finest first.
  const std::vector<ImageView<uint8_t>>& levels() const { return levels_; }
  /// Gray value in the usual mean and contrast: gain() gray + offset().
  float gain() const { return gain_; }
  float offset() const { return offset_; }

 private:
  std::shared_ptr<const FramePyramid> frame_;
  std::vector<Plane<uint8_t>> coarser_;
  std::vector<ImageView<uint8_t>> levels_;
  float gain_ = 1, offset_ = 0;
};

/// Follows the patch of 9x9 pixels around `from` in `before`; the search in `now` begins at `start`; pixels
/// of the finest level. Nothing: the patch shows no corner, or is not found. Cost: 1 us.
std::optional<Eigen::Vector2f> follow_patch(const FlowImage& before, const FlowImage& now,
                                            const Eigen::Vector2f& from, const Eigen::Vector2f& start);

}  // namespace edgevo
