// SPDX-License-Identifier: BSD-3-Clause
#include "map_section.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"

namespace edgevo {
namespace {

constexpr int kMaxPixels = 1000, kMinPixels = 500;  // along the longer side of the picture

cv::Vec3b color_of(GridCell cell) {
  switch (cell) {
    case GridCell::kOccupied:
      return {0, 0, 0};
    case GridCell::kFree:
      return {254, 254, 254};
    case GridCell::kUnknown:
      return {205, 205, 205};
  }
  return {};
}

// The grid as a picture: forward (x) is up, left (y) is left. A pixel with several cells shows occupied
// before free before unknown, as in the grid itself.
class GridPicture {
 public:
  explicit GridPicture(const OccupancyGrid& grid) : grid_(grid) {
    const int longer = std::max(grid.width, grid.height);
    cells_a_pixel_ = 1 + (longer - 1) / kMaxPixels;
    pixels_a_cell_ = std::max(1, kMinPixels / longer);
    draw_cells();
  }
  void draw_path(const std::vector<std::optional<Eigen::Vector3d>>& path) {
    const cv::Scalar blue(191, 95, 31);
    for (size_t i = 1; i < path.size(); ++i)
      if (path[i - 1] && path[i])
        cv::line(image_, pixel_of(*path[i - 1]), pixel_of(*path[i]), blue, 2, cv::LINE_AA);
  }
  int width() const { return image_.cols; }
  std::vector<uint8_t> png() const {
    std::vector<uint8_t> bytes;
    cv::imencode(".png", image_, bytes);
    return bytes;
  }

 private:
  void draw_cells() {
    const int rows = 1 + (grid_.width - 1) / cells_a_pixel_,
              columns = 1 + (grid_.height - 1) / cells_a_pixel_;
    cv::Mat small(rows, columns, CV_8UC3);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        small.at<cv::Vec3b>(row, column) =
            color_of(strongest((rows - 1 - row) * cells_a_pixel_, (columns - 1 - column) * cells_a_pixel_));
    cv::resize(small, image_, {}, pixels_a_cell_, pixels_a_cell_, cv::INTER_NEAREST);
  }
  GridCell strongest(int x0, int y0) const {
    GridCell strongest = GridCell::kUnknown;
    for (int y = y0; y < std::min(grid_.height, y0 + cells_a_pixel_); ++y)
      for (int x = x0; x < std::min(grid_.width, x0 + cells_a_pixel_); ++x)
        strongest = std::max(strongest, grid_.at(x, y));
    return strongest;
  }
  cv::Point pixel_of(const Eigen::Vector3d& p_map) const {
    const double pixels = double(pixels_a_cell_) / (grid_.resolution * cells_a_pixel_);
    return {int(image_.cols - (p_map.y() - grid_.origin_y) * pixels),
            int(image_.rows - (p_map.x() - grid_.origin_x) * pixels)};
  }

  const OccupancyGrid& grid_;
  int cells_a_pixel_ = 1, pixels_a_cell_ = 1;
  cv::Mat image_;
};

// Positions of the camera, with gaps at frames without a pose and between segments.
std::vector<std::optional<Eigen::Vector3d>> camera_path(const Run& run) {
  std::vector<std::optional<Eigen::Vector3d>> path;
  const SE3 T_map = T_map_world(run);
  int segment = -1;
  for (const FrameRecord& f : run.frames) {
    if (f.segment != segment) path.emplace_back();
    segment = f.segment;
    const bool posed = f.T_world_cam && f.T_world_cam->is_finite();
    path.push_back(posed ? std::optional<Eigen::Vector3d>((T_map * *f.T_world_cam).translation())
                         : std::nullopt);
  }
  return path;
}

std::string length(const Run& run, double value, int digits) {
  return fixed(value, digits) + (run.is_metric() ? " m" : " units");
}

std::string octree_tiles(const Run& run, const OctreeStats& stats) {
  const double voxel_volume = std::pow(stats.resolution, 3);
  return tiles_html(
      {{length(run, stats.resolution, 3), "voxel size"},
       {length(run, stats.max_range, 2), "range"},
       {std::to_string(stats.occupied_voxels), "occupied voxels"},
       {std::to_string(stats.free_voxels), "free voxels"},
       {fixed(double(stats.free_voxels) * voxel_volume, 1) + (run.is_metric() ? " m³" : " units³"),
        "observed to be free"},
       {std::to_string(stats.points.kept) + " of " + std::to_string(stats.points.total),
        "edge points in the map"}});
}

}  // namespace

std::string map_section(const Run& run, const MapReport& map) {
  if (map.octree.points.kept == 0)
    return section_html("map", "Map for planners",
                        note_html("No edge point is certain enough for the map: it is empty."));
  std::string body = octree_tiles(run, map.octree);
  if (map.grid) {
    GridPicture picture(*map.grid);
    picture.draw_path(camera_path(run));
    body +=
        "<div style=\"max-width:" + std::to_string(picture.width()) + "px\">" +
        figure_html("png", picture.png(), "the 2D grid from above", "grid.yaml from above, forward is up") +
        "</div>\n" +
        note_html(std::to_string(map.grid->width) + " x " + std::to_string(map.grid->height) +
                  " cells: black occupied, white free, gray unknown, blue the path of the camera; " +
                  map.grid->statement);
  }
  return section_html(
      "map", "Map for planners",
      body + note_html("Another resolution, without running again: edgevo map . -o OUT --resolution LENGTH"));
}

}  // namespace edgevo
