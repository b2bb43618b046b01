// SPDX-License-Identifier: BSD-3-Clause
#include "packed_problem.h"

#include <algorithm>
#include <cmath>

#include "edgevo/bundle_adjustment/problem_index.h"

namespace edgevo::ba {
namespace {

// Depth of the point in the target times its inverse depth: the ratio of its depths in target and host.
double depth_ratio(const RelativePose& T, const Eigen::Vector3d& ray, double idepth) {
  return T.R[6] * ray.x() + T.R[7] * ray.y() + T.R[8] * ray.z() + idepth * T.t[2];
}

PackedObservation reduce(const Pinhole& pinhole, const BaObservation& o, int index) {
  const Eigen::Vector2d focal(pinhole.fx, pinhole.fy);
  const Eigen::Vector2d centred = o.px - Eigen::Vector2d(pinhole.cx, pinhole.cy);
  const Eigen::Vector2d n = o.inv_sigma_normal * o.normal;
  const Eigen::Vector2d d = o.inv_sigma_tangent * Eigen::Vector2d(-o.normal.y(), o.normal.x());
  return {{Rows{n.x(), d.x()} * focal.x(), Rows{n.y(), d.y()} * focal.y(),
           Rows{-n.dot(centred), -d.dot(centred)}},
          kHiddenResidualPx * o.inv_sigma_normal,
          o.target,
          index};
}

void find_targets(PackedProblem* packed) {
  packed->targets.assign(packed->pose_count, {packed->pose_count, -1});
  for (int h = 0; h < packed->pose_count; ++h)
    for (int i = packed->host_begin[h]; i < packed->host_begin[h + 1]; ++i) {
      TargetRange& range = packed->targets[h];
      const PackedPoint& p = packed->points[i];  // its observations are sorted by target
      range.first = std::min(range.first, packed->observations[p.begin].target);
      range.last = std::max(range.last, packed->observations[p.end - 1].target);
    }
}

}  // namespace

RelativePose relative_pose(const SE3& T) {
  RelativePose relative;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(relative.R) = T.R();
  Eigen::Map<Eigen::Vector3d>(relative.t) = T.translation();
  return relative;
}

std::vector<RelativePose> all_relative_poses(const std::vector<SE3>& poses) {
  std::vector<RelativePose> relative;
  relative.reserve(poses.size() * poses.size());
  for (const SE3& host : poses) {
    const SE3 T_world_host = host.inverse();
    for (const SE3& target : poses) relative.push_back(relative_pose(target * T_world_host));
  }
  return relative;
}

State initial_state(const BaProblem& problem, double min_idepth) {
  State state;
  for (const BaPose& pose : problem.poses) state.poses.push_back(pose.T_cam_world);
  state.idepth.reserve(problem.points.size());
  for (const BaPoint& p : problem.points)
    state.idepth.push_back(p.fixed ? p.idepth : std::max(p.idepth, min_idepth));
  return state;
}

PackedProblem pack_problem(const BaProblem& problem, const State& state, const std::vector<bool>* skip) {
  const int n = static_cast<int>(problem.poses.size());
  const std::vector<RelativePose> relative = all_relative_poses(state.poses);
  const ProblemIndex index = index_problem(problem);
  PackedProblem packed;
  packed.pose_count = n;
  packed.host_begin.assign(n + 1, 0);
  packed.points.reserve(problem.points.size());
  packed.observations.reserve(problem.observations.size());
  for (const int i : index.points) {
    if (skip && (*skip)[i]) continue;
    const BaPoint& p = problem.points[i];
    const int begin = static_cast<int>(packed.observations.size());
    for (int k = index.first_observation[i]; k < index.first_observation[i + 1]; ++k) {
      const BaObservation& o = problem.observations[k];
      if (depth_ratio(relative[p.host * n + o.target], p.ray, state.idepth[i]) > kMinDepthRatio)
        packed.observations.push_back(reduce(problem.pinhole, o, k));
    }
    const int end = static_cast<int>(packed.observations.size());
    if (begin == end) continue;
    // Breaking ties by index makes the order, and thus every bit of the sums, a function of the problem
    // alone.
    std::sort(packed.observations.begin() + begin, packed.observations.end(),
              [](const PackedObservation& a, const PackedObservation& b) {
                return a.target != b.target ? a.target < b.target : a.index < b.index;
              });
    packed.points.push_back({{p.ray.x(), p.ray.y(), p.ray.z()},
                             begin,
                             end,
                             i,
                             p.fixed,
                             p.known_idepth,
                             p.fixed ? 0.0 : p.known_information});
    ++packed.host_begin[p.host + 1];
  }
  for (int h = 0; h < n; ++h) packed.host_begin[h + 1] += packed.host_begin[h];
  find_targets(&packed);
  return packed;
}

}  // namespace edgevo::ba
