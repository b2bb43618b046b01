// SPDX-License-Identifier: BSD-3-Clause
#include "moved_view.h"

#include <algorithm>
#include <cmath>

#include "edgevo/map/corrected_pixel.h"

namespace edgevo {

RememberedView moved_view(const Rectification& rectification, const LensChange& lens,
                          const ImageMotion& motion, const RememberedView& view) {
  RememberedView moved = view;
  const auto correct = [&](const Eigen::Vector2d& px) {
    return correct_pixel(rectification, lens.before, lens.now, motion, px);
  };
  for (Eigen::Vector2f& px : moved.corners.px) px = correct(px.cast<double>()).cast<float>();
  const double finest =
      double(rectification.target().fx) / view.edges.pinhole.fx;  // pixels there to one here
  const auto packed = [](double x) { return uint16_t(std::clamp<long>(std::lround(16 * x), 0, 65535)); };
  for (std::array<uint16_t, 2>& at : moved.edges.at) {
    const Eigen::Vector2d px = correct(finest / 16 * Eigen::Vector2d(at[0], at[1])) / finest;
    at = {packed(px.x()), packed(px.y())};
  }
  return moved;
}

}  // namespace edgevo
