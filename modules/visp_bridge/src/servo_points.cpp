// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/servo_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace edgevo {
namespace {

using Jacobian = Eigen::Matrix<double, 3, 6>;

// Farthest-point sampling: takes the candidate farthest from all taken so far, beginning with the one
// farthest from the middle of the image.
std::vector<size_t> spread_choice(const std::vector<Eigen::Vector2d>& candidates,
                                  const Eigen::Vector2d& middle, size_t count) {
  std::vector<double> distance;
  for (const Eigen::Vector2d& c : candidates) distance.push_back((c - middle).norm());
  std::vector<size_t> taken;
  while (taken.size() < std::min(count, candidates.size())) {
    const size_t best = size_t(std::max_element(distance.begin(), distance.end()) - distance.begin());
    taken.push_back(best);
    for (size_t i = 0; i < candidates.size(); ++i) {
      const double d = (candidates[i] - candidates[best]).norm();
      distance[i] = taken.size() == 1 ? d : std::min(distance[i], d);
    }
  }
  return taken;
}

// d(x, y, Z) / dp of x = X/Z, y = Y/Z, Z.
Eigen::Matrix3d feature_jacobian(const Eigen::Vector3d& p) {
  Eigen::Matrix3d J;
  J << 1 / p.z(), 0, -p.x() / (p.z() * p.z()), 0, 1 / p.z(), -p.y() / (p.z() * p.z()), 0, 0, 1;
  return J;
}

// Variances of (x, y, Z) due to the pose, p_cam <- exp(xi) p_cam, and the depth.
Eigen::Vector3d feature_variances(const Eigen::Vector3d& p_cam, const Eigen::Vector3d& sigma_cam,
                                  const Matrix6d& covariance) {
  Jacobian J_pose;
  J_pose << Eigen::Matrix3d::Identity(), -skew(p_cam);
  const Eigen::Matrix3d J = feature_jacobian(p_cam);
  const Eigen::Matrix3d S = J_pose * covariance * J_pose.transpose() + sigma_cam * sigma_cam.transpose();
  return (J * S * J.transpose()).diagonal();
}

}  // namespace

ServoPoints::Chosen ServoPoints::make(const CloudPoint& point, const Reference& reference) {
  const SE3 T_map_ref = reference.T_ref_world.inverse();
  const Eigen::Vector3d p_ref = point.ray / point.idepth;
  // sigma_z = sigma_rho / rho^2, along the ray.
  const Eigen::Vector3d sigma_ref = point.ray * point.idepth_sigma / (point.idepth * point.idepth);
  return {point.host_keyframe, point.host_pixel, T_map_ref * p_ref, T_map_ref.rotation() * sigma_ref};
}

int ServoPoints::choose(const ServoPose& pose, int count) {
  chosen_.clear();
  map_version_ = pose.map_version;
  if (!pose.usable || !pose.view.reference) return 0;
  const Reference& reference = *pose.view.reference;
  std::vector<Chosen> candidates;
  std::vector<Eigen::Vector2d> px;
  for (const CloudPoint& p : reference.cloud.points) {
    if (p.host_keyframe < 0 || !(p.idepth_sigma <= options_.max_relative_sigma * p.idepth)) continue;
    const Chosen candidate = make(p, reference);
    const Eigen::Vector3d p_cam = *pose.view.T_cam_map * candidate.p_map;
    if (!(p_cam.z() > 0) || !pinhole_.contains(pinhole_.project(p_cam), options_.border_px)) continue;
    candidates.push_back(candidate);
    px.push_back(pinhole_.project(p_cam));
  }
  const Eigen::Vector2d middle(0.5 * pinhole_.width, 0.5 * pinhole_.height);
  for (size_t i : spread_choice(px, middle, size_t(std::max(count, 0)))) chosen_.push_back(candidates[i]);
  followed_ = pose.view.reference;
  return int(chosen_.size());
}

// Updates depth and position of points that the newest reference still holds.
void ServoPoints::follow_map(const std::shared_ptr<const Reference>& reference) {
  if (!reference || reference == followed_) return;
  std::map<std::pair<int, int>, const CloudPoint*> by_name;
  for (const CloudPoint& p : reference->cloud.points) by_name[{p.host_keyframe, p.host_pixel}] = &p;
  for (Chosen& c : chosen_) {
    const auto found = by_name.find({c.host_keyframe, c.host_pixel});
    if (found != by_name.end()) c = make(*found->second, *reference);
  }
  followed_ = reference;
}

std::vector<ServoPoint> ServoPoints::features(const ServoPose& pose) {
  std::vector<ServoPoint> points;
  if (!pose.usable || pose.map_version != map_version_) return points;
  follow_map(pose.view.reference);
  const double metres = pose.scale.metres_per_unit;
  const SE3& T_cam_map = *pose.view.T_cam_map;
  for (const Chosen& c : chosen_) {
    const Eigen::Vector3d p = T_cam_map * c.p_map;
    ServoPoint s;
    s.host_keyframe = c.host_keyframe;
    s.host_pixel = c.host_pixel;
    s.in_view = p.z() > 0 && pinhole_.contains(pinhole_.project(p));
    s.point.set_xyZ(p.x() / p.z(), p.y() / p.z(), metres * p.z());
    s.point3d.set_XYZ(metres * p.x(), metres * p.y(), metres * p.z());
    const Eigen::Vector3d variance =
        feature_variances(p, T_cam_map.rotation() * c.sigma_map, pose.view.covariance);
    s.sigma_x = std::sqrt(variance[0]);
    s.sigma_y = std::sqrt(variance[1]);
    s.sigma_Z = metres * std::sqrt(variance[2]);
    points.push_back(s);
  }
  return points;
}

}  // namespace edgevo
