// SPDX-License-Identifier: BSD-3-Clause
#include "live_frames.h"

namespace edgevo {
namespace {

SE3 mount_of(const std::optional<SE3>& T_vehicle_cam, bool is_metric) {
  Run run;  // for T_map_world(): what the files of the run do
  run.T_vehicle_cam = T_vehicle_cam;
  if (is_metric) run.scale_source = "metres";
  return T_map_world(run);
}

}  // namespace

LiveFrames::LiveFrames(const std::optional<SE3>& T_vehicle_cam, bool is_metric)
    : T_base_cam_(mount_of(T_vehicle_cam, is_metric)), is_metric_(is_metric) {}

void LiveFrames::follow(const EpochsPlaced& placed) {
  ++changes_;
  T_world_odom_ = placed.T_world_odom;
  if (placed.epochs.empty()) return;
  epochs_ = placed.epochs;
  T_odom_map_[placed.segment] = placed.T_odom_map;
}

// Away from the origin of the world a change of the unit moves T_map_odom, too.
void LiveFrames::set_metres_per_unit(double factor, double sigma) {
  scale_sigma_ = sigma;
  if (factor == factor_) return;
  const SE3 before = T_map_odom();
  offset_ += (factor_ - factor) * newest_;
  factor_ = factor;
  changes_ += (T_map_odom().translation() - before.translation()).norm() > 0;
}

SE3 LiveFrames::T_odom_base(const SE3& T_odom_cam) const {
  return T_base_cam_ * to_metres().apply(T_odom_cam) * T_base_cam_.inverse();
}

SE3 LiveFrames::T_map_odom() const {
  const Eigen::Matrix3d R = T_world_odom_.R();
  const SE3 in_metres(T_world_odom_.rotation(),
                      factor_ * T_world_odom_.translation() + offset_ - R * offset_);
  return T_base_cam_ * in_metres * T_base_cam_.inverse();
}

Sim3 LiveFrames::T_world_segment(int segment, int keyframe_id) const {
  const EpochPlace* found = nullptr;
  for (const EpochPlace& e : epochs_)
    if (e.segment == segment && e.first_keyframe <= keyframe_id) found = &e;
  if (found) return found->T_world_map;
  const auto known = T_odom_map_.find(segment);
  return Sim3{1, T_world_odom_} * (known == T_odom_map_.end() ? Sim3() : known->second);
}

Sim3 LiveFrames::T_map_segment(int segment, int keyframe_id) const {
  return Sim3{1, T_base_cam_} * to_metres() * T_world_segment(segment, keyframe_id);
}

double LiveFrames::metres_per_map_unit(int segment) const {
  const auto known = T_odom_map_.find(segment);
  return factor_ * (known == T_odom_map_.end() ? 1 : known->second.scale);
}

Matrix6d body_covariance(const Matrix6d& covariance, double length, const SE3& T_base_cam) {
  Matrix6d J = T_base_cam.adjoint();
  J.leftCols<3>() *= length;
  return J * covariance * J.transpose();
}

// R exp(w) = exp(R w) R
Matrix6d in_parent(const Matrix6d& body_covariance, const SE3& T_parent_base) {
  Matrix6d R = Matrix6d::Zero();
  R.topLeftCorner<3, 3>() = R.bottomRightCorner<3, 3>() = T_parent_base.R();
  return R * body_covariance * R.transpose();
}

}  // namespace edgevo
