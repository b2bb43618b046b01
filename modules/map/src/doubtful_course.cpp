// SPDX-License-Identifier: BSD-3-Clause
#include "doubtful_course.h"

#include <cmath>
#include <utility>

namespace edgevo {
namespace {

// Variance of the random walk of the unit: no step is without any, so that one of sure frames counts, too.
constexpr double kLeastDoubt = 1e-3;

// Turns and moves a pose by a share of what leads from one pose to another.
SE3 moved_by_share(const SE3& T, const SE3& T_from, const SE3& T_to, double share) {
  const Eigen::Quaterniond turn = T_to.rotation() * T_from.rotation().conjugate();
  return {Eigen::Quaterniond::Identity().slerp(share, turn) * T.rotation(),
          T.translation() + share * (T_to.translation() - T_from.translation())};
}

}  // namespace

DoubtfulCourse::DoubtfulCourse(std::vector<KeyframeInMap> keyframes,
                               const std::function<double(int, int)>& doubt)
    : keyframes_(std::move(keyframes)), progress_(1, 0.0) {
  for (size_t i = 1; i < keyframes_.size(); ++i)
    progress_.push_back(progress_.back() + kLeastDoubt +
                        doubt(keyframes_[i - 1].frame_index, keyframes_[i].frame_index));
  const double all = progress_.back();
  for (double& p : progress_)
    if (all > 0) p /= all;
}

// With x_0 as in the map:  x_{i+1} = x_i + sqrt(s_i s_{i+1}) (p_{i+1} - p_i),  s_i = ratio^progress_i.
std::vector<Eigen::Vector3d> DoubtfulCourse::chain(double ratio) const {
  std::vector<Eigen::Vector3d> x{keyframes_.front().T_map_cam.translation()};
  for (size_t i = 1; i < keyframes_.size(); ++i) {
    const double scale = std::pow(ratio, 0.5 * (progress_[i - 1] + progress_[i]));
    x.push_back(x.back() +
                scale * (keyframes_[i].T_map_cam.translation() - keyframes_[i - 1].T_map_cam.translation()));
  }
  return x;
}

Eigen::Vector3d DoubtfulCourse::end(double ratio) const { return chain(ratio).back(); }

double DoubtfulCourse::length() const {
  double length = 0;
  for (size_t i = 1; i < keyframes_.size(); ++i)
    length += (keyframes_[i].T_map_cam.translation() - keyframes_[i - 1].T_map_cam.translation()).norm();
  return length;
}

int DoubtfulCourse::frames() const { return keyframes_.back().frame_index - keyframes_.front().frame_index; }

std::vector<Sim3> DoubtfulCourse::place(const Sim3& T_world_first, const Sim3& T_world_last) const {
  const double ratio = T_world_last.scale / T_world_first.scale;
  const std::vector<Eigen::Vector3d> x = chain(ratio);
  const auto chained = [&](size_t i) {
    return T_world_first.apply(SE3(keyframes_[i].T_map_cam.rotation(), x[i]));
  };
  const SE3 end = chained(x.size() - 1), right_end = T_world_last.apply(keyframes_.back().T_map_cam);
  std::vector<Sim3> T_world_map;
  for (size_t i = 0; i < x.size(); ++i) {
    const SE3 placed = moved_by_share(chained(i), end, right_end, progress_[i]);
    const SE3& T_map_cam = keyframes_[i].T_map_cam;
    Sim3 T{T_world_first.scale * std::pow(ratio, progress_[i]), SE3()};
    const Eigen::Quaterniond rotation = placed.rotation() * T_map_cam.rotation().conjugate();
    T.rigid = SE3(rotation, placed.translation() - T.scale * (rotation * T_map_cam.translation()));
    T_world_map.push_back(T);
  }
  return T_world_map;
}

}  // namespace edgevo
