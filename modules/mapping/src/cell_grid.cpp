// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace edgevo {
namespace {

int number_of(int pixels, int cell_px) { return (pixels + cell_px - 1) / cell_px; }

// True for finite numbers, each greater than the one before.
bool ascends(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }) &&
         std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

// Raw positions along the row (axis 0) or column (axis 1) of the principal point, at the borders of pixels.
std::vector<double> raw_borders(const Rectification& rectification, int axis) {
  const Pinhole& target = rectification.target();
  Eigen::Vector2d px(target.cx, target.cy);
  std::vector<double> raw;
  for (int i = 0; i <= (axis == 0 ? target.width : target.height); ++i) {
    px[axis] = i - 0.5;
    raw.push_back(rectification.raw_pixel(target.ray(px).head<2>())[axis]);
  }
  return raw;
}

CellAxis axis_of(const Rectification& rectification, int axis, int cell_px) {
  const Pinhole& target = rectification.target();
  const int pixels = axis == 0 ? target.width : target.height;
  if (rectification.camera().plumb_bob()) return {pixels, cell_px};
  return {pixels, cell_px, raw_borders(rectification, axis)};
}

}  // namespace

CellAxis::CellAxis(int pixels, int cell_px) {
  for (int i = 0; i < pixels; ++i) of.push_back(i / cell_px);
  for (int k = 0; k <= number_of(pixels, cell_px); ++k) begin.push_back(k * cell_px);
}

CellAxis::CellAxis(int pixels, int cell_px, const std::vector<double>& raw) : CellAxis(pixels, cell_px) {
  if (!ascends(raw)) return;
  const int intervals = size();
  const double length = (raw.back() - raw.front()) / intervals;
  std::fill(begin.begin(), begin.end(), pixels);
  for (int i = pixels - 1; i >= 0; --i) {
    of[i] = std::clamp(int((0.5 * (raw[i] + raw[i + 1]) - raw.front()) / length), 0, intervals - 1);
    begin[of[i]] = i;
  }
  // An interval within a pixel has none of its own.
  for (int k = intervals - 1; k >= 0; --k) begin[k] = std::min(begin[k], begin[k + 1]);
}

CellGrid::CellGrid(const Rectification& rectification, int cell_px)
    : x_(axis_of(rectification, 0, cell_px)), y_(axis_of(rectification, 1, cell_px)) {}

}  // namespace edgevo
