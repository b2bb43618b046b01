// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/turn_by_gyro.h"

#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/motion_tolerance.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo {

TurnDifference TurnByGyro::add(Timestamp time, const Eigen::Quaterniond& R_cam_map, const Turn& turn) {
  frames_.push_back({time, R_cam_map});
  if (frames_.size() > size_t(kMotionTolerance.frames) + 1) frames_.pop_front();
  const Posed& from = frames_.front();
  const std::optional<CameraTurn> by_gyro = turn(from.time, time);
  if (!by_gyro) return {};
  const Eigen::Vector3d off =
      rotation_vector(R_cam_map * from.R_cam_map.conjugate() * by_gyro->R.conjugate());
  const Eigen::Vector3d axis = off.stableNormalized();
  return {deg(off.norm()), deg(std::sqrt(axis.dot(by_gyro->covariance * axis)))};
}

}  // namespace edgevo
