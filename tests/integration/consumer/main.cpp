// SPDX-License-Identifier: BSD-3-Clause
// Uses the installed headers and libraries: a drive evaluated against itself in another unit.
#include <edgevo/core/se3.h>
#include <edgevo/evaluation/evaluate.h>
#include <cmath>
#include <cstdio>

int main() {
  edgevo::Trajectory truth{"truth", edgevo::TrajectoryFormat::kTum, {}},
      estimate{"estimate", edgevo::TrajectoryFormat::kTum, {}};
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p(std::sin(0.1 * i), 0, i);
    truth.poses.push_back(
        {edgevo::Timestamp::from_seconds(0.1 * i), edgevo::SE3(Eigen::Quaterniond::Identity(), p)});
    estimate.poses.push_back({truth.poses.back().time, edgevo::SE3(Eigen::Quaterniond::Identity(), p / 4)});
  }
  const edgevo::TrajectoryEvaluation e = edgevo::evaluate(estimate, truth, {});
  std::printf("scale %.3f, ATE %.3f m\n", e.ate_sim3.scale, e.ate_sim3.rmse);
  return std::abs(e.ate_sim3.scale - 4) < 1e-9 ? 0 : 1;
}
