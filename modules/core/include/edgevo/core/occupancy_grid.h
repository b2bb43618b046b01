// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A 2D occupancy grid as a plain value: built by the module occupancy, read by the writers for map_server and
// MRPT.
#include <cstdint>
#include <string>
#include <vector>

namespace edgevo {

/// State of a cell; unknown, unlike free, means that no ray has passed through it.
enum class GridCell : uint8_t { kUnknown, kFree, kOccupied };

/// A grid of square cells, seen from above, axes as the world of the map files (x forward, z up).
struct OccupancyGrid {
  /// Number of cells along x and along y.
  int width = 0, height = 0;
  /// Side of a cell, unit of the run.
  double resolution = 0;
  /// X of the lower left corner of cell (0, 0), in the world frame of the map files.
  double origin_x = 0;
  /// Y of the lower left corner of cell (0, 0).
  double origin_y = 0;
  /// Cells row by row from the smallest y up: cells[y * width + x].
  std::vector<GridCell> cells;
  /// Heights that the grid covers and its unit, one line.
  std::string statement;

  /// Cell at column x and row y, not checked.
  GridCell at(int x, int y) const { return cells[size_t(y) * size_t(width) + size_t(x)]; }
};

}  // namespace edgevo
