// SPDX-License-Identifier: BSD-3-Clause
#include "cell_statistics.h"

#include <algorithm>
#include <stdexcept>

#include "edgevo/core/mean_and_error.h"

namespace edgevo {
namespace {

std::vector<double> drifts(const StudyCell& cell) {
  std::vector<double> values;
  for (const StudySample& s : cell.samples) values.push_back(s.drift_percent);
  return values;
}

}  // namespace

CellStatistics statistics(const StudyCell& cell) {
  CellStatistics c;
  c.pairs = int(cell.samples.size());
  for (const StudySample& s : cell.samples) c.failed += s.failed;
  const double n = std::max(1, c.pairs - c.failed);
  for (const StudySample& s : cell.samples) {
    if (s.failed) continue;
    c.rotation_mean_deg += s.rotation_deg / n;
    c.direction_mean_deg += s.direction_deg / n;
    c.matches += s.matches / n;
    c.photometric += s.photometric / n;
    c.wrong_share += s.wrong_share / n;
    c.median_px += s.median_px / n;
    c.match_ms += s.match_ms / n;
    c.solve_ms += s.solve_ms / n;
    c.track_ms += s.track_ms / n;
  }
  std::vector<double> drift = drifts(cell);
  const MeanAndError mean = mean_and_error(drift);
  c.drift_mean = mean.mean;
  c.drift_error = mean.error;
  std::sort(drift.begin(), drift.end());
  if (!drift.empty()) c.drift_median = drift[drift.size() / 2];
  return c;
}

Difference drift_difference(const StudyCell& a, const StudyCell& b) {
  std::vector<double> difference = drifts(a);
  const std::vector<double> other = drifts(b);
  for (size_t i = 0; i < difference.size(); ++i) difference[i] -= other[i];
  const MeanAndError d = mean_and_error(difference);
  return {d.mean, d.error};
}

const StudyCell& find_cell(const StudyResult& result, const std::string& curve, const std::string& light,
                           const std::string& method, const std::string& setting) {
  for (const StudyCell& cell : result.cells)
    if (cell.curve == curve && cell.light == light && cell.method == method && cell.setting == setting)
      return cell;
  throw std::logic_error("the study has no " + curve + " of " + method + " at " + setting);
}

}  // namespace edgevo
