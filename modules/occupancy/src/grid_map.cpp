// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/grid_map.h"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "auto_or_length.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

constexpr int64_t kMaxCells = int64_t(1) << 28;  // 256 MB
// Gray values as written by ROS map_saver; occupied is 0.
constexpr uint8_t kGrayFree = 254, kGrayUnknown = 205;

struct Band {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};

// Heights of the band at each cell.
class BandAlongThePath {
 public:
  BandAlongThePath(const Run& run, double camera_height, const GridParams& params)
      : camera_height_(camera_height), params_(params) {
    const SE3 T_map = T_map_world(run);
    for (const KeyframeRecord& k : run.keyframes) {
      const Eigen::Vector3d p = (T_map * k.T_world_cam).translation();
      // One position per camera height of path is enough; a standstill adds none.
      if (cameras_.empty() || (p - cameras_.back()).norm() > camera_height_) cameras_.push_back(p);
    }
  }
  Band at(double x, double y) const {
    if (camera_height_ <= 0 || cameras_.empty()) return {};
    const Eigen::Vector2d here(x, y);
    const auto nearest =
        std::min_element(cameras_.begin(), cameras_.end(), [&](const auto& a, const auto& b) {
          return (a.template head<2>() - here).squaredNorm() < (b.template head<2>() - here).squaredNorm();
        });
    const double ground = nearest->z() - camera_height_;
    return {ground + params_.band_low * camera_height_, ground + params_.band_high * camera_height_};
  }

 private:
  double camera_height_;
  GridParams params_;
  std::vector<Eigen::Vector3d> cameras_;
};

OccupancyGrid empty_grid(const octomap::OcTree& tree) {
  OccupancyGrid grid;
  grid.resolution = tree.getResolution();
  double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  if (tree.size() > 0)
    tree.getMetricMin(low[0], low[1], low[2]), tree.getMetricMax(high[0], high[1], high[2]);
  const auto cells = [&](int axis) {
    return std::max<int64_t>(1, std::llround((high[axis] - low[axis]) / grid.resolution));
  };
  const double least = grid.resolution * std::sqrt(double(cells(0) * cells(1)) / double(kMaxCells));
  if (cells(0) * cells(1) > kMaxCells)
    throw InputError("grid", "would have " + std::to_string(cells(0) * cells(1)) + " cells",
                     "give a resolution of " + fixed(1.01 * least, 6) + " or more");
  grid.width = int(cells(0)), grid.height = int(cells(1));
  grid.origin_x = low[0], grid.origin_y = low[1];
  grid.cells.assign(size_t(grid.width) * size_t(grid.height), GridCell::kUnknown);
  return grid;
}

// Occupied wins over free, free over unknown.
void raise(GridCell value, GridCell* cell) { *cell = std::max(*cell, value); }

void flatten(const octomap::OcTree& tree, const BandAlongThePath& bands, OccupancyGrid* grid) {
  std::vector<Band> band;  // one for each cell
  for (int y = 0; y < grid->height; ++y)
    for (int x = 0; x < grid->width; ++x)
      band.push_back(bands.at(grid->origin_x + (x + 0.5) * grid->resolution,
                              grid->origin_y + (y + 0.5) * grid->resolution));
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    const GridCell value = tree.isNodeOccupied(*leaf) ? GridCell::kOccupied : GridCell::kFree;
    const double half = leaf.getSize() / 2;
    const int side = int(std::lround(leaf.getSize() / grid->resolution));
    const int x0 = int(std::lround((leaf.getX() - half - grid->origin_x) / grid->resolution));
    const int y0 = int(std::lround((leaf.getY() - half - grid->origin_y) / grid->resolution));
    for (int y = std::max(0, y0); y < std::min(grid->height, y0 + side); ++y)
      for (int x = std::max(0, x0); x < std::min(grid->width, x0 + side); ++x) {
        const size_t cell = size_t(y) * size_t(grid->width) + size_t(x);
        if (leaf.getZ() + half > band[cell].low && leaf.getZ() - half < band[cell].high)
          raise(value, &grid->cells[cell]);
      }
  }
}

// Frees all cells within `radius` of the line from a to b.
void free_along(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius, OccupancyGrid* grid) {
  const Eigen::Vector2d origin(grid->origin_x, grid->origin_y), span = b - a;
  const Eigen::Vector2d low = (a.cwiseMin(b) - origin).array() - radius,
                        high = (a.cwiseMax(b) - origin).array() + radius;
  const auto first = [&](double x) { return std::max(0, int(std::floor(x / grid->resolution))); };
  const auto last = [&](double x, int size) {
    return std::min(size - 1, int(std::floor(x / grid->resolution)));
  };
  for (int y = first(low.y()); y <= last(high.y(), grid->height); ++y)
    for (int x = first(low.x()); x <= last(high.x(), grid->width); ++x) {
      const Eigen::Vector2d p = origin + grid->resolution * Eigen::Vector2d(x + 0.5, y + 0.5);
      const double share =
          span.squaredNorm() > 0 ? std::clamp(span.dot(p - a) / span.squaredNorm(), 0.0, 1.0) : 0;
      if ((a + share * span - p).norm() <= radius)
        grid->cells[size_t(y) * size_t(grid->width) + size_t(x)] = GridCell::kFree;
    }
}

// Frees the corridor driven by the vehicle, including cells on its border.
void free_driven_corridor(const Run& run, double width, OccupancyGrid* grid) {
  const double radius = 0.5 * width + 0.71 * grid->resolution;
  const SE3 T_map = T_map_world(run);
  const FrameRecord* last = nullptr;
  for (const FrameRecord& f : run.frames) {
    if (!f.T_world_cam || !f.T_world_cam->is_finite()) continue;
    const Eigen::Vector2d here = (T_map * f.T_world_cam->translation()).head<2>();
    const bool goes_on = last && last->segment == f.segment;
    free_along(goes_on ? Eigen::Vector2d((T_map * last->T_world_cam->translation()).head<2>()) : here, here,
               radius, grid);
    last = &f;
  }
}

std::string statement_of(const Run& run, double camera_height, const GridParams& params) {
  const std::string unit = "; unit: " + unit_statement(run);
  if (camera_height <= 0) return "all heights, since the ground is not known (set grid.camera_height)" + unit;
  return "heights " + fixed(params.band_low * camera_height, 3) + " to " +
         fixed(params.band_high * camera_height, 3) + " over the ground, which lies " +
         fixed(camera_height, 3) + " under the camera's way" + unit;
}

uint8_t gray(GridCell cell) {
  switch (cell) {
    case GridCell::kOccupied:
      return 0;
    case GridCell::kFree:
      return kGrayFree;
    case GridCell::kUnknown:
      return kGrayUnknown;
  }
  return kGrayUnknown;
}

std::string pgm(const OccupancyGrid& grid) {
  std::string bytes = "P5\n# " + grid.statement + "\n" + std::to_string(grid.width) + " " +
                      std::to_string(grid.height) + "\n255\n";
  for (int y = grid.height - 1; y >= 0; --y)
    for (int x = 0; x < grid.width; ++x) bytes += char(gray(grid.at(x, y)));
  return bytes;
}

}  // namespace

void GridParams::visit(ParamVisitor& v) {
  v.text(
      kBasic, "camera_height", camera_height, {},
      "height of the camera above the ground, unit of the run, or auto: from --scale, the observed ground or "
      "the mount");
  v.number(kBasic, "band_low", band_low, -10, 10,
           "lower end of the band of heights shown in the grid, in camera heights above the ground");
  v.number(kBasic, "band_high", band_high, -10, 100,
           "upper end of the band of heights shown in the grid, in camera heights above the ground");
  v.number(kAdvanced, "driven_width", driven_width, 0, 10,
           "width of the travelled corridor that is marked free, in camera heights; 0: as the map shows it");
}

double GridParams::given_camera_height() const { return auto_or_length("grid.camera_height", camera_height); }

void GridParams::check() const {
  given_camera_height();
  if (!(band_low < band_high))
    throw InputError("grid.band_low", "is not below grid.band_high", "give for example 0.18 and 1.1");
}

OccupancyGrid make_grid(const Run& run, const OctreeMap& map, double camera_height,
                        const GridParams& params) {
  OccupancyGrid grid = empty_grid(map.tree());
  flatten(map.tree(), BandAlongThePath(run, camera_height, params), &grid);
  if (camera_height > 0 && params.driven_width > 0)
    free_driven_corridor(run, params.driven_width * camera_height, &grid);
  grid.statement = statement_of(run, camera_height, params);
  return grid;
}

void write_ros_grid(const OccupancyGrid& grid, const std::string& yaml_path) {
  const std::filesystem::path image = std::filesystem::path(yaml_path).replace_extension(".pgm");
  write_file(image.string(), pgm(grid));
  std::string yaml = "# " + grid.statement + "\nimage: " + image.filename().string() +
                     "\nmode: trinary\nresolution: " + fixed(grid.resolution, 9) + "\norigin: [" +
                     fixed(grid.origin_x, 6) + ", " + fixed(grid.origin_y, 6) +
                     ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  write_file(yaml_path, yaml);
}

}  // namespace edgevo
