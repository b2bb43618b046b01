#pragma once
// The way of the camera as report.html shows it.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "truth_comparison.h"

namespace edgevo {

/// Positions in map axes (x forward, y left, z up), and in metres where the truth tells.
struct ShownPath {
  std::string unit;
  double metres_per_unit = 1;
  std::vector<std::optional<Eigen::Vector3d>> estimate, truth;  ///< one for each frame
};

ShownPath path_of(const Run& run, const std::optional<TruthComparison>& truth);

/// Sum of the steps within segments, in the path's unit.
double path_length(const ShownPath& path, const Run& run);

}  // namespace edgevo
