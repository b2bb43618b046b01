// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The path of the camera as shown in report.html.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "truth_comparison.h"

namespace edgevo {

/// Positions in map axes (x forward, y left, z up), in metres if the run is metric or aligned with ground
/// truth.
struct ShownPath {
  /// Unit of the positions: "m" or "units".
  std::string unit;
  /// Factor from the unit of the run to that of the path.
  double metres_per_unit = 1;
  /// Positions, one for each frame; nullopt: none.
  std::vector<std::optional<Eigen::Vector3d>> estimate, truth;
};

/// Path of the run, and the true path if `truth` is given.
ShownPath path_of(const Run& run, const std::optional<TruthComparison>& truth);

/// Length of the estimated path within segments, in the path's unit.
double path_length(const ShownPath& path, const Run& run);

}  // namespace edgevo
