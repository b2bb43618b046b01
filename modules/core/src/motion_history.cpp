// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/motion_history.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace edgevo {

// ---- frames ----

void MotionHistory::add(const Tracked& frame) {
  add_measured(frame.T_cur_last, frame.frames, frame.held);
  T_cam_path_ = frame.T_cur_last * T_cam_path_;
  add_in_map(frame.T_map_cam, frame.stands);
}

void MotionHistory::add_measured(const SE3& T_cur_last, int frames, bool held) {
  // A camera that stands at a light goes on as fast as it came.
  constexpr double kStands = 0.1;
  const double step = T_cur_last.translation().norm() / std::max(frames, 1);
  if (!(step < kStands * measured_.median())) {
    measured_.add(step);
    direction_ = T_cur_last.translation().normalized();
  }
  if (frames <= 1)
    median_motion_.follow(T_cur_last.log().head<3>(), held);
  else
    median_motion_.interrupt();
}

void MotionHistory::add_in_map(const SE3& T_map_cam, bool stands) {
  constexpr size_t kPoses = size_t(kMotionTolerance.frames) + 1;
  newest_ = {};
  if (!poses_.empty())
    newest_.step = (T_map_cam.translation() - poses_.back().T_map_cam.translation()).norm();
  if (!stands) in_map_.add(newest_.step);
  newest_.usual = in_map_.median();
  poses_.push_back({T_map_cam, T_cam_path_});
  if (poses_.size() > kPoses) poses_.pop_front();
  const Placed &from = poses_.front(), &to = poses_.back();
  const SE3 in_map = to.T_map_cam.inverse() * from.T_map_cam,
            measured = to.T_cam_path * from.T_cam_path.inverse();
  newest_.turn_rad = from.T_map_cam.rotation().angularDistance(to.T_map_cam.rotation());
  newest_.length = in_map.translation().norm();
  newest_.moved_by_map = (in_map.translation() - measured.translation()).norm();
}

void MotionHistory::begin_map() {
  measured_.clear();
  in_map_.clear();
  direction_.setZero();
  median_motion_ = MedianMotion();
  interrupt();
}

// ---- what is usual ----

double MotionHistory::largest_step(double times, double median_depth) const {
  const double usual = measured_.median();
  if (!std::isfinite(usual)) return std::numeric_limits<double>::infinity();
  return times * std::max({usual, measured_.mean(1), kSmallStep * median_depth});
}

Eigen::Vector3d MotionHistory::typical_step() const {
  const double usual = measured_.median();
  return std::isfinite(usual) ? Eigen::Vector3d(usual * direction_) : Eigen::Vector3d::Zero();
}

}  // namespace edgevo
