// SPDX-License-Identifier: BSD-3-Clause
#include "map_lengths.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

// Voxel size of an empty map, unit of the run.
constexpr double kResolutionWithoutPoints = 0.1;

double median_depth(const Run& run, const PointFilter& filter) {
  std::vector<double> depths;
  for (const KeyframeRecord& keyframe : run.keyframes)
    for (const EdgePoint& p : keyframe.points)
      if (filter.keeps(p)) depths.push_back(1.0 / double(p.idepth));
  return median(std::move(depths));
}

// Largest "auto" voxel size of a metric run, metres: coarser voxels block the corridors that a vehicle has
// driven.
constexpr double kCoarsestMetric = 0.2;

// Length that a pixel spans at `depth`: smaller voxels show nothing that the image does.
double pixel_footprint(const Pinhole& camera, double depth) { return depth / camera.fx; }

// Two significant digits, so that "auto" gives a length that is easy to read and to type.
double round_to_two_digits(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::round(x / unit) * unit;
}

double length_or_share(double given, double share, double median, double without_points) {
  if (given > 0) return given;
  return median > 0 ? round_to_two_digits(share * median) : without_points;
}

}  // namespace

MapLengths map_lengths(const Run& run, const OccupancyParams& params) {
  MapLengths lengths;
  lengths.median_depth = median_depth(run, params.points);
  lengths.resolution = length_or_share(params.given_resolution(), params.resolution_share,
                                       lengths.median_depth, kResolutionWithoutPoints);
  if (run.is_metric() && params.given_resolution() <= 0)
    lengths.resolution = std::min(
        lengths.resolution, std::max(kCoarsestMetric, pixel_footprint(run.pinhole, lengths.median_depth)));
  lengths.max_range =
      length_or_share(params.given_max_range(), params.max_range_share, lengths.median_depth, 0);
  return lengths;
}

}  // namespace edgevo
