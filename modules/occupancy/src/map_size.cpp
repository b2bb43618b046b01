// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/map_size.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "map_lengths.h"

namespace edgevo {
namespace {

constexpr double kReach = 32768;     // voxels from the origin that octomap's keys reach
constexpr double kMaxSamples = 2e6;  // along all rays: half a second
// Measured on maps of 0.2 to 20 million voxels, including the copy for .bt.
constexpr double kBytesPerVoxel = 110;
constexpr double kOutsideShare = 0.01;  // share of the points: outliers lie anywhere
constexpr double kMaxGridCells = 2e8;   // below what make_grid() refuses
constexpr double kCoarser = 1.5;        // from one resolution that is tried to the next
constexpr int kMaxTries = 200;
constexpr double kUsableShare = 0.8;  // share of the free memory; the run and other programs need the rest

// A ray from the camera to a point, in the world of the map.
struct MapRay {
  Eigen::Vector3d from, to;
};

std::vector<MapRay> rays_of(const Run& run, const OccupancyParams& params, double max_range) {
  std::vector<MapRay> rays;
  const SE3 T_map = T_map_world(run);
  for (const KeyframeRecord& keyframe : run.keyframes) {
    if (!keyframe.T_world_cam.is_finite()) continue;
    const SE3 T_map_cam = T_map * keyframe.T_world_cam;
    for (const EdgePoint& p : keyframe.points) {
      if (!params.points.keeps(p)) continue;
      const Eigen::Vector3d p_cam = point_in_camera(run.pinhole, p);
      if (p_cam.norm() <= max_range) rays.push_back({T_map_cam.translation(), T_map_cam * p_cam});
    }
  }
  return rays;
}

double total_length(const std::vector<MapRay>& rays) {
  double sum = 0;
  for (const MapRay& r : rays) sum += (r.to - r.from).norm();
  return sum;
}

// Upper bound on the number of crossed voxels, as if no voxel were crossed by two rays: a ray leaves each
// voxel along one of three axes.
double most_voxels(const std::vector<MapRay>& rays, double resolution) {
  return 3 * (total_length(rays) / resolution + double(rays.size()));
}

uint64_t key_of(const Eigen::Vector3d& p, double cell) {
  constexpr int kBits = 21;
  constexpr int64_t kOffset = int64_t{1} << (kBits - 1), kMask = (int64_t{1} << kBits) - 1;
  uint64_t key = 0;
  for (int i = 0; i < 3; ++i)
    key = key << kBits | uint64_t((int64_t(std::floor(p[i] / cell)) + kOffset) & kMask);
  return key;
}

// Number of cells of size `cell` that the rays cross.
double crossed_cells(const std::vector<MapRay>& rays, double cell) {
  std::vector<uint64_t> keys;
  for (const MapRay& r : rays) {
    // Two samples a cell: octomap's ray traversal visits every cell, even at corners.
    const int steps = std::max(1, int(std::ceil(2 * (r.to - r.from).norm() / cell)));
    for (int i = 0; i <= steps; ++i)
      keys.push_back(key_of(r.from + (r.to - r.from) * (double(i) / steps), cell));
  }
  std::sort(keys.begin(), keys.end());
  return double(std::unique(keys.begin(), keys.end()) - keys.begin());
}

// Number of crossed cells as a power of their size.
struct Growth {
  double cell = 1, cells = 0, power = 3;
  double at(double resolution) const { return cells * std::pow(cell / resolution, power); }
  double resolution_of(double voxels) const { return cell * std::pow(cells / voxels, 1 / power); }
};

Growth growth_of(const std::vector<MapRay>& rays, double resolution) {
  Growth growth;
  growth.cell = std::max(resolution, 2 * total_length(rays) / kMaxSamples);
  growth.cells = crossed_cells(rays, growth.cell);
  const double coarser = std::max(1.0, crossed_cells(rays, 2 * growth.cell));
  growth.power = std::clamp(std::log2(growth.cells / coarser), 1.0, 3.0);
  return growth;
}

// Coordinate that all but kOutsideShare of the points stay within.
double extent_of(const std::vector<MapRay>& rays) {
  std::vector<double> far;
  for (const MapRay& r : rays) far.push_back(r.to.cwiseAbs().maxCoeff());
  if (far.empty()) return 0;
  const auto nth = far.begin() + std::ptrdiff_t(double(far.size() - 1) * (1 - kOutsideShare));
  std::nth_element(far.begin(), nth, far.end());
  return *nth;
}

double outside_share(const std::vector<MapRay>& rays, double reach) {
  const auto outside = std::count_if(rays.begin(), rays.end(),
                                     [&](const MapRay& r) { return r.to.cwiseAbs().maxCoeff() >= reach; });
  return rays.empty() ? 0 : double(outside) / double(rays.size());
}

// Cells of a grid over all points that the octree holds.
double grid_cells(const std::vector<MapRay>& rays, double resolution) {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();
  for (const MapRay& r : rays) {
    if (!(r.to.cwiseAbs().maxCoeff() < kReach * resolution)) continue;
    low = low.cwiseMin(r.to.head<2>()), high = high.cwiseMax(r.to.head<2>());
  }
  return ((high - low) / resolution).prod();
}

double rounded_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::ceil(x / unit) * unit;
}

std::string in_gigabytes(double bytes) { return fixed(bytes / 1e9, bytes < 1e10 ? 1 : 0) + " GB"; }

// A length with its significant digits: 0.024, not 0.023999999.
std::string length_text(double length) {
  return fixed(length, std::max(0, 1 - int(std::floor(std::log10(length)))));
}

}  // namespace

MapSize estimate_map_size(const Run& run, const OccupancyParams& params) {
  const MapLengths lengths = map_lengths(run, params);
  const std::vector<MapRay> rays = rays_of(run, params, lengths.max_range);
  MapSize size;
  size.resolution = lengths.resolution;
  if (rays.empty()) return size;
  size.voxels = growth_of(rays, lengths.resolution).at(lengths.resolution);
  size.bytes = kBytesPerVoxel * size.voxels;
  size.outside_share = outside_share(rays, kReach * lengths.resolution);
  return size;
}

void check_map_size(const Run& run, const OccupancyParams& params, double free_bytes,
                    const std::string& where) {
  const MapLengths lengths = map_lengths(run, params);
  const std::vector<MapRay> rays = rays_of(run, params, lengths.max_range);
  const double extent = extent_of(rays);
  if (params.resolution != "auto" && extent > 0 && lengths.resolution > extent)
    throw InputError(where, "one voxel of that size would hold the whole run",
                     "give a resolution well below " + length_text(extent));
  const double usable = kUsableShare * free_bytes, reach = kReach * lengths.resolution;
  const bool reaches = outside_share(rays, reach) <= kOutsideShare;
  if (reaches && kBytesPerVoxel * most_voxels(rays, lengths.resolution) <= usable) return;
  const Growth growth = growth_of(rays, lengths.resolution);
  const double bytes = kBytesPerVoxel * growth.at(lengths.resolution);
  if (reaches && bytes <= usable) return;
  const double holds = growth.resolution_of(usable / kBytesPerVoxel);
  const double least = rounded_up(std::max(holds, extent / kReach));
  throw InputError(
      where,
      "voxels of " + length_text(lengths.resolution) +
          (reaches ? " would take about " + in_gigabytes(bytes) + " of memory, " + in_gigabytes(free_bytes) +
                         " are free"
                   : " reach only " + length_text(reach) + " from the origin, the run goes farther"),
      "give a resolution of " + length_text(least) + " or more");
}

std::string coarsen_to_fit(const Run& run, double free_bytes, OccupancyParams* params) {
  if (params->resolution != "auto") return {};
  const MapLengths lengths = map_lengths(run, *params);
  const std::vector<MapRay> rays = rays_of(run, *params, lengths.max_range);
  const double voxels = kUsableShare * free_bytes / kBytesPerVoxel;
  const auto fits = [&](double resolution) {
    return outside_share(rays, kReach * resolution) <= kOutsideShare &&
           grid_cells(rays, resolution) <= kMaxGridCells &&
           (most_voxels(rays, resolution) <= voxels || growth_of(rays, resolution).at(resolution) <= voxels);
  };
  double resolution = lengths.resolution;
  for (int tries = 0; tries < kMaxTries && !fits(resolution); ++tries) resolution *= kCoarser;
  if (resolution == lengths.resolution) return {};
  params->resolution = fixed(rounded_up(resolution), 9);
  return "voxels of " + length_text(rounded_up(resolution)) + " instead of " +
         length_text(lengths.resolution) + ", which cannot hold the run: it goes " +
         length_text(extent_of(rays)) + " far";
}

double free_memory() {
  std::ifstream info("/proc/meminfo");
  std::string key;
  for (double kilobytes = 0; info >> key >> kilobytes;
       info.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (key == "MemAvailable:") return 1024 * kilobytes;
  return std::numeric_limits<double>::infinity();
}

}  // namespace edgevo
