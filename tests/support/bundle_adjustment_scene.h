// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Synthetic windows for the tests and the benchmark of bundle adjustment: a camera moving forward past
// random points.
#include <cmath>
#include <numeric>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/core/random.h"

namespace edgevo::test {

struct SceneOptions {
  int poses = 7;
  int points = 300;
  /// Share of the other poses that see a point.
  double observed_share = 0.7;
  /// Share of the observations that also measure along the edge.
  double share_2d = 0.5;
  double noise_px = 0;
  /// Share of the observations that are off by up to 30 px.
  double outlier_share = 0;
  int fixed_poses = 2;
  double fixed_point_share = 0;
  /// Number of corners seen in each pair of neighbouring poses, without noise.
  int corners = 0;
  uint64_t seed = 1;
};

inline Pinhole pinhole() { return {720, 710, 610, 180, 1241, 376}; }

inline Vector6d random_tangent(Random* random, double translation, double rotation) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = (i < 3 ? translation : rotation) * random->uniform(-1, 1);
  return xi;
}

inline std::vector<BaPose> make_poses(const SceneOptions& o, Random* random) {
  std::vector<BaPose> poses(o.poses);
  for (int i = 0; i < o.poses; ++i) {
    const SE3 T_world_cam = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.2 * i, 0.05 * i, 0.8 * i)) *
                            SE3::exp(random_tangent(random, 0.1, 0.03));
    poses[i] = {T_world_cam.inverse(), i < o.fixed_poses};
  }
  return poses;
}

inline BaObservation observe(const BaProblem& p, int point, int target, const SceneOptions& o,
                             Random* random) {
  const BaPoint& x = p.points[point];
  const SE3 T_target_host = p.poses[target].T_cam_world * p.poses[x.host].T_cam_world.inverse();
  BaObservation m;
  m.point = point;
  m.target = target;
  const double angle = random->uniform(0, 2 * M_PI);
  m.normal = {std::cos(angle), std::sin(angle)};
  m.inv_sigma_normal = random->uniform(1, 3);
  m.inv_sigma_tangent = random->uniform() < o.share_2d ? random->uniform(0.5, 2) : 0.0;
  m.px = p.pinhole.project(T_target_host * Eigen::Vector3d(x.ray / x.idepth));
  m.px += o.noise_px * Eigen::Vector2d(random->normal(), random->normal());
  if (random->uniform() < o.outlier_share)
    m.px += Eigen::Vector2d(random->uniform(-30, 30), random->uniform(-30, 30));
  return m;
}

inline BaCornerPair observe_corner(const BaProblem& p, int from, int to, Random* random) {
  const SE3 T_to_from = p.poses[to].T_cam_world * p.poses[from].T_cam_world.inverse();
  const Eigen::Vector3d ray = p.pinhole.ray({random->uniform(100, 1141), random->uniform(20, 356)});
  const Eigen::Vector3d x = T_to_from * Eigen::Vector3d(ray * random->uniform(6, 40));
  return {from, to, ray, x / x.z(), random->uniform(1, 3)};
}

/// A problem at its true poses and depths; perturb() moves it away from them.
inline BaProblem make_scene(const SceneOptions& o) {
  Random random(o.seed);
  BaProblem p;
  p.pinhole = pinhole();
  p.poses = make_poses(o, &random);
  p.pose_ids.resize(o.poses);
  std::iota(p.pose_ids.begin(), p.pose_ids.end(), 100);
  for (int i = 0; i < o.points; ++i) {
    BaPoint x;
    x.host = random.below(o.poses);
    x.ray = p.pinhole.ray({random.uniform(100, 1141), random.uniform(20, 356)});
    x.idepth = 1.0 / random.uniform(6, 40);
    x.fixed = random.uniform() < o.fixed_point_share;
    p.points.push_back(x);
    for (int target = 0; target < o.poses; ++target)
      if (target != x.host && random.uniform() < o.observed_share)
        p.observations.push_back(observe(p, i, target, o, &random));
  }
  for (int to = 1; to < o.poses; ++to)
    for (int i = 0; i < o.corners; ++i) p.corners.push_back(observe_corner(p, to - 1, to, &random));
  return p;
}

inline BaProblem perturb(BaProblem p, double translation, double rotation, double relative_depth,
                         uint64_t seed) {
  Random random(seed);
  for (BaPose& pose : p.poses)
    if (!pose.fixed)
      pose.T_cam_world = SE3::exp(random_tangent(&random, translation, rotation)) * pose.T_cam_world;
  for (BaPoint& x : p.points)
    if (!x.fixed) x.idepth *= 1 + relative_depth * random.uniform(-1, 1);
  return p;
}

/// Largest entry of log(T_a T_b^-1) over all poses.
inline double pose_difference(const BaProblem& a, const BaProblem& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    largest = std::max(
        largest, (a.poses[i].T_cam_world * b.poses[i].T_cam_world.inverse()).log().cwiseAbs().maxCoeff());
  return largest;
}

inline double depth_difference(const BaProblem& a, const BaProblem& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    largest = std::max(largest, std::abs(a.points[i].idepth - b.points[i].idepth));
  return largest;
}

/// Options for a solve down to the minimum, within the precision of doubles.
inline BaOptions to_the_end() {
  BaOptions options;
  options.max_iterations = 100;
  options.relative_decrease = 1e-13;
  return options;
}

}  // namespace edgevo::test
