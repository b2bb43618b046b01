// SPDX-License-Identifier: BSD-3-Clause
#include "shown_path.h"

namespace edgevo {

ShownPath path_of(const Run& run, const std::optional<TruthComparison>& truth) {
  ShownPath path;
  path.metres_per_unit = truth ? truth->metres_per_unit : 1;
  path.unit = run.is_metric() || truth ? "m" : "units";
  const SE3 T = T_map_world(run);
  for (size_t i = 0; i < run.frames.size(); ++i) {
    const auto& pose = run.frames[i].T_world_cam;
    const bool posed = pose && pose->is_finite();
    path.estimate.push_back(
        posed ? std::optional<Eigen::Vector3d>(path.metres_per_unit * (T * pose->translation()))
              : std::nullopt);
    path.truth.push_back(truth && truth->p_world[i] ? std::optional<Eigen::Vector3d>(T * *truth->p_world[i])
                                                    : std::nullopt);
  }
  return path;
}

double path_length(const ShownPath& path, const Run& run) {
  double length = 0;
  size_t last = path.estimate.size();
  for (size_t i = 0; i < path.estimate.size(); ++i) {
    if (!path.estimate[i]) continue;
    if (last < i && run.frames[last].segment == run.frames[i].segment)
      length += (*path.estimate[i] - *path.estimate[last]).norm();
    last = i;
  }
  return length;
}

}  // namespace edgevo
