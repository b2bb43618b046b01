#include "edgevo/report/stage_times.h"

#include <algorithm>
#include <cmath>

namespace edgevo {

std::vector<std::pair<std::string, std::vector<double>>> stage_times(const Run& run) {
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  for (const FrameRecord& frame : run.frames)
    for (const auto& [name, ms] : frame.stage_ms) {
      auto stage =
          std::find_if(stages.begin(), stages.end(), [&, &n = name](const auto& s) { return s.first == n; });
      if (stage == stages.end()) stage = stages.insert(stages.end(), {name, {}});
      stage->second.push_back(ms);
    }
  return stages;
}

std::vector<std::string> stages_of(const Run& run) {
  std::vector<std::string> names;
  for (const auto& stage : stage_times(run)) names.push_back(stage.first);
  return names;
}

std::vector<double> total_ms(const Run& run) {
  std::vector<double> totals;
  for (const FrameRecord& f : run.frames) {
    totals.push_back(0);
    for (const auto& stage : f.stage_ms) totals.back() += stage.second;
  }
  return totals;
}

double percentile(const std::vector<double>& sorted, double share) {
  const auto rank = size_t(std::ceil(share * double(sorted.size())));
  return sorted[std::max<size_t>(rank, 1) - 1];
}

}  // namespace edgevo
