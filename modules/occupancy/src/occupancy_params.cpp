// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/occupancy_params.h"

#include <charconv>
#include <cmath>

#include "auto_or_length.h"
#include "edgevo/core/error.h"

namespace edgevo {

double auto_or_length(const std::string& key, const std::string& text) {
  if (text == "auto") return 0;
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop == end && std::isfinite(value) && value > 0) return value;
  throw InputError(key, "'" + text + "' is neither auto nor a positive number",
                   "write auto or a length in the unit of the run, for example 0.2");
}

void OccupancyParams::visit(ParamVisitor& v) {
  v.text(kBasic, "resolution", resolution, {}, "voxel size in the unit of the run, or auto");
  v.number(kAdvanced, "resolution_share", resolution_share, 0.001, 1,
           "auto resolution as a share of the median point depth");
  v.text(kBasic, "max_range", max_range, {},
         "largest distance of mapped points from the path, unit of the run, or auto");
  v.number(kAdvanced, "max_range_share", max_range_share, 0.1, 100,
           "auto range as a multiple of the median point depth");
  v.number(kAdvanced, "carve_max_relative_sigma", carve_max_relative_sigma, 0, 1,
           "points carve free space if idepth_sigma/idepth is at most this");
  v.integer(kAdvanced, "carve_neighbours", carve_neighbours, 0, 100,
            "points carve if this many other points of their segment are near; outliers are alone");
  v.number(kAdvanced, "prob_hit", prob_hit, 0.51, 0.99, "occupancy of a voxel with a point, per observation");
  v.number(kAdvanced, "prob_miss", prob_miss, 0.01, 0.49,
           "occupancy of a voxel that a ray crosses, per keyframe");
  auto group = v.group("points");
  points.visit(v);
}

double OccupancyParams::given_resolution() const {
  return auto_or_length("occupancy.resolution", resolution);
}
double OccupancyParams::given_max_range() const { return auto_or_length("occupancy.max_range", max_range); }

void OccupancyParams::check() const {
  given_resolution();
  given_max_range();
}

}  // namespace edgevo
