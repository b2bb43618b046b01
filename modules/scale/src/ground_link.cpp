// SPDX-License-Identifier: BSD-3-Clause
#include "ground_link.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "edgevo/run_quality/doubtful_intervals.h"
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

// The ground links two parts that nothing else links, or nothing as certain.
std::optional<RelativeScale> comparison(const std::optional<ScaleEstimate>& before,
                                        const std::optional<ScaleEstimate>& after,
                                        const RelativeScale& known) {
  if (!before || !after) return std::nullopt;
  RelativeScale unit;
  unit.ratio = after->factor / before->factor;
  unit.sigma = std::hypot(before->sigma, after->sigma);
  unit.by_ground = true;
  if (known.is_linked() && !(unit.sigma < known.sigma)) return std::nullopt;
  return unit;
}

// New over old lengths of each unit, all in that of the first. What links two parts is noted.
std::vector<double> link(const std::vector<DoubtfulInterval>& compared, const HeightOfUnit& heights,
                         Run* run) {
  std::vector<double> factors{1};
  size_t shown = 0;  // the last unit that shows ground
  for (size_t u = 1; u < heights.size(); ++u) {
    const DoubtfulInterval& interval = compared[u - 1];
    factors.push_back(factors.back());
    if (const auto by_ground = comparison(heights[shown], heights[u], *interval.unit)) {
      factors.back() = factors[shown] * by_ground->ratio;
      run->frames[size_t(interval.compared_at)].evidence.unit = by_ground;
    }
    if (heights[u]) shown = u;
  }
  return factors;
}

}  // namespace

void link_units_by_ground(const ScaleParams& params, Run* run) {
  std::vector<DoubtfulInterval> compared;  // another unit may begin at each
  std::vector<int> begins;
  for (DoubtfulInterval& interval : doubtful_intervals(*run)) {
    if (!interval.unit) continue;
    begins.push_back(interval.first_frame);
    compared.push_back(std::move(interval));
  }
  if (compared.empty()) return;
  const std::vector<UnitPath> paths = paths_by_unit(*run, begins);
  const HeightOfUnit heights = heights_by_unit(*run, paths, compared.size() + 1, params);
  const std::vector<double> factor_of_unit = link(compared, heights, run);
  if (std::all_of(factor_of_unit.begin(), factor_of_unit.end(), [](double f) { return f == 1; })) return;
  std::map<int, int> unit_of;  // by frame
  for (const UnitPath& of_unit : paths)
    for (const PathPose& pose : of_unit.path) unit_of[pose.frame_index] = of_unit.unit;
  std::vector<double> factors;
  for (const FrameRecord& frame : run->frames) {
    const auto unit = unit_of.find(frame.index);
    factors.push_back(unit != unit_of.end() ? factor_of_unit[size_t(unit->second)] : 1);
  }
  rescale_final(factors, run);
}

}  // namespace edgevo
