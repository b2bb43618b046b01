// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/gridmap_writer.h"

#include <mrpt/maps/COccupancyGridMap2D.h>

#include "object_file.h"

namespace edgevo {
namespace {

float probability_of_free(GridCell cell) {
  switch (cell) {
    case GridCell::kOccupied:
      return 0.01f;
    case GridCell::kFree:
      return 0.99f;
    case GridCell::kUnknown:
      return 0.5f;
  }
  return 0.5f;
}

}  // namespace

void write_gridmap(const OccupancyGrid& grid, const std::string& path) {
  const auto resolution = float(grid.resolution);
  const auto x0 = float(grid.origin_x), y0 = float(grid.origin_y);
  mrpt::maps::COccupancyGridMap2D map(x0, x0 + float(grid.width) * resolution, y0,
                                      y0 + float(grid.height) * resolution, resolution);
  // MRPT rounds the corners to multiples of a cell, so that cells are identified by position.
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      if (grid.at(x, y) != GridCell::kUnknown)
        map.setPos(float(grid.origin_x + (x + 0.5) * grid.resolution),
                   float(grid.origin_y + (y + 0.5) * grid.resolution), probability_of_free(grid.at(x, y)));
  ObjectFile out(path);
  out.write(map);
  out.close();
}

}  // namespace edgevo
