#pragma once
// A run beside its ground truth, where that is known.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/evaluation/absolute_error.h"
#include "edgevo/evaluation/relative_error.h"

namespace edgevo {

struct TruthComparison {
  double metres_per_unit = 1;  ///< that the alignment multiplied the run with; 1 for a run in metres
  AbsoluteError error;         ///< after the alignment: Sim(3), or SE(3) for a run in metres
  std::vector<std::optional<Eigen::Vector3d>>
      p_world;                 ///< true position at each frame, in the run's world; metres
  std::optional<Drift> drift;  ///< as `edgevo eval` gives it; none where the truth does not move
};

/// Reads the trajectory file at `path` and aligns it with the run. nullopt if there is none or it cannot be
/// compared: `*why_not` then says why (empty for an empty path).
std::optional<TruthComparison> compare_with_truth(const Run& run, const std::string& path,
                                                  std::string* why_not);

}  // namespace edgevo
