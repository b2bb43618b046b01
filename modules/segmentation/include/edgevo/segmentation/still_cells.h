// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace edgevo {

/// The part of a view that stands still while the camera seems to stand: cells over the image, known from the
/// edges and the steepest pixels between them. They have kept their place, within half a pixel of the
/// coarsest level with edges, since before the camera seemed to stand.
struct StillCells {
  /// Number of cells across and down; 0: the view moves.
  int columns = 0, rows = 0;
  /// By row: 1 for a cell that stands still.
  std::vector<uint8_t> is_still = {};
  /// Number of images in a row, up to this one, in which the camera was not seen to move, whatever crosses
  /// the view.
  int images = 0;
  /// Whether, since the camera seemed to stand, nearly all of the view was seen to stand still.
  bool is_certain = false;

  /// Whether there are none.
  bool empty() const { return is_still.empty(); }
  /// Whether as many as a column of them stand still. Else nothing shows that the camera does: all is hidden,
  /// it may have driven off behind that, and what seems still is so by chance.
  bool show_it() const {
    return std::count(is_still.begin(), is_still.end(), uint8_t(1)) >= std::max(rows, 1);
  }
  /// Whether a place lies in one of them; shares of width and height, 0 to below 1.
  bool contain(double across, double down) const {
    return !empty() && is_still[size_t(int(down * rows) * columns + int(across * columns))] != 0;
  }
};

}  // namespace edgevo
