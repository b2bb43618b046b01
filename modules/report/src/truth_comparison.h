// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Comparison of a run with its ground truth, if that is known.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/evaluation/absolute_error.h"
#include "edgevo/evaluation/relative_error.h"

namespace edgevo {

/// A run aligned with its ground truth.
struct TruthComparison {
  /// Scale of the alignment; 1 for a run in metres.
  double metres_per_unit = 1;
  /// Absolute error after alignment with Sim(3), or SE(3) for a run in metres.
  AbsoluteError error;
  /// True position at each frame, in the run's world, metres.
  std::vector<std::optional<Eigen::Vector3d>> p_world;
  /// Drift as computed by `edgevo eval`; nullopt if the truth does not move.
  std::optional<Drift> drift;
};

/// Reads the trajectory file at `path` and aligns it with the run. Returns nullopt if there is none or it
/// cannot be compared; `*why_not` then gives the reason (empty for an empty path).
std::optional<TruthComparison> compare_with_truth(const Run& run, const std::string& path,
                                                  std::string* why_not);

}  // namespace edgevo
