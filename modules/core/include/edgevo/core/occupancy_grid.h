#pragma once
// A 2D occupancy grid as a plain value: occupancy makes it, map_server's and MRPT's writers read it.
#include <cstdint>
#include <string>
#include <vector>

namespace edgevo {

/// Unknown is kept apart from free: no ray has been there.
enum class GridCell : uint8_t { kUnknown, kFree, kOccupied };

/// A grid of square cells, seen from above, axes as the world of the map files (x forward, z up).
struct OccupancyGrid {
  int width = 0, height = 0;    ///< cells along x and along y
  double resolution = 0;        ///< edge of a cell, unit of the run
  double origin_x = 0;          ///< of the lower left corner of cell (0, 0), in the world of the map files
  double origin_y = 0;          ///< of the same corner
  std::vector<GridCell> cells;  ///< row by row from the least y up: cells[y * width + x]
  std::string statement;        ///< which heights are in it and what its unit is, one line

  /// 0 <= x < width, 0 <= y < height, not checked
  GridCell at(int x, int y) const { return cells[size_t(y) * size_t(width) + size_t(x)]; }
};

}  // namespace edgevo
