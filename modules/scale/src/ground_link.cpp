// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/ground_link.h"

#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "edgevo/core/doubtful_intervals.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/path.h"
#include "rescale.h"

namespace edgevo {
namespace {

using HeightOfUnit = std::vector<std::optional<ScaleEstimate>>;  // camera heights a unit, by unit

HeightOfUnit heights_by_unit(const Run& run, const std::vector<UnitPath>& paths, size_t units,
                             const ScaleParams& params) {
  std::vector<std::vector<HeightSample>> samples(units);
  for (const UnitPath& of_unit : paths) {
    std::vector<HeightSample>& of = samples[size_t(of_unit.unit)];
    const std::vector<HeightSample> more = ground_heights(run, of_unit.path, params);
    of.insert(of.end(), more.begin(), more.end());
  }
  HeightOfUnit heights;
  for (const auto& of : samples) heights.push_back(fit_height(of, 1.0, params));
  return heights;
}

// New over old lengths of each unit: the first one that shows ground decides.
std::vector<double> factors_of(const HeightOfUnit& heights) {
  std::vector<double> factors;
  std::optional<double> first;
  for (const auto& height : heights) {
    if (height && !first) first = height->factor;
    factors.push_back(height ? height->factor / *first : factors.empty() ? 1 : factors.back());
  }
  return factors;
}

UnitComparison comparison(const ScaleEstimate& before, const ScaleEstimate& after) {
  UnitComparison unit;
  unit.ratio = after.factor / before.factor;
  unit.sigma = std::hypot(before.sigma, after.sigma);
  unit.by_ground = true;
  return unit;
}

}  // namespace

void link_units_by_ground(const ScaleParams& params, Run* run) {
  std::vector<int> compared_at;  // where another unit begins
  for (const DoubtfulInterval& interval : doubtful_intervals(*run))
    if (interval.is_unit_unlinked()) compared_at.push_back(interval.compared_at);
  if (compared_at.empty()) return;
  const std::vector<UnitPath> paths = paths_by_unit(*run);
  const HeightOfUnit heights = heights_by_unit(*run, paths, compared_at.size() + 1, params);
  const std::vector<double> factor_of_unit = factors_of(heights);

  std::map<int, int> unit_of;  // by frame
  for (const UnitPath& of_unit : paths)
    for (const PathPose& pose : of_unit.path) unit_of[pose.frame_index] = of_unit.unit;
  std::vector<double> factors;
  for (const FrameRecord& frame : run->frames) {
    const auto unit = unit_of.find(frame.index);
    factors.push_back(unit != unit_of.end() ? factor_of_unit[size_t(unit->second)] : 1);
  }
  rescale_final(factors, run);
  for (size_t u = 1; u < heights.size(); ++u)
    if (heights[u - 1] && heights[u])
      run->frames[size_t(compared_at[u - 1])].evidence.unit = comparison(*heights[u - 1], *heights[u]);
}

}  // namespace edgevo
