// SPDX-License-Identifier: BSD-3-Clause
#include "pulling_group.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/alignment/pose_covariance.h"
#include "edgevo/alignment/pose_evidence.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr double kNear = 0.5;           // median inverse depths: what has parallax
constexpr double kPulledSquare = 27.9;  // chi^2 with six degrees of freedom: by chance in one of 10,000

// The points with a known depth that a condition holds for, without patches.
template <class F>
ReferenceCloud part_where(const ReferenceCloud& all, const F& holds) {
  ReferenceCloud part;
  part.pyramid = all.pyramid;
  for (size_t i = 0; i < all.points.size(); ++i)
    if (all.points[i].host_keyframe >= 0 && holds(i)) part.points.push_back(all.points[i]);
  return part;
}

ReferenceCloud near_part(const ReferenceCloud& all) {
  std::vector<double> idepths;
  for (const CloudPoint& c : all.points)
    if (c.host_keyframe >= 0) idepths.push_back(c.idepth);
  const double least = idepths.empty() ? 0 : kNear * median(std::move(idepths));
  return part_where(all, [&](size_t i) { return all.points[i].idepth > least; });
}

ReferenceCloud part_without(const ReferenceCloud& all, const std::vector<int>& group) {
  std::vector<bool> is_in(all.points.size(), false);
  for (int i : group) is_in[size_t(i)] = true;
  return part_where(all, [&](size_t i) { return !is_in[i]; });
}

struct MeasuredPose {
  SE3 T_cur_ref;
  Matrix6d covariance;
  double square_to(const SE3& T) const {
    const Vector6d xi = (T * T_cur_ref.inverse()).log();
    return xi.dot(covariance.ldlt().solve(xi));
  }
};

// By a part of the map, whose points are as wrong as tracking has found them to be.
MeasuredPose measure(const FramePyramid& current, const ReferenceCloud& part, double error_factor,
                     const SE3& start, const AlignmentParams& params) {
  MeasuredPose pose{start, Matrix6d::Zero()};
  align_edges(current, part, 0, params, &pose.T_cur_ref);
  pose.covariance =
      std::max(1.0, error_factor) * pose_covariance(pose_equations(current, part, pose.T_cur_ref, params));
  return pose;
}

}  // namespace

MovingGroup find_pulling_group(const FramePyramid& current, const Reference& reference, const SE3& T_cur_ref,
                               const AlignmentParams& params) {
  const ReferenceCloud& cloud = reference.cloud;
  const MeasuredPose by_near = measure(current, near_part(cloud), reference.error_factor, T_cur_ref, params);
  if (!(by_near.square_to(T_cur_ref) > kPulledSquare)) return {};
  const double turn_sigma_px =
      current.finest().pinhole.fx * std::sqrt(by_near.covariance.bottomRightCorner<3, 3>().trace());
  MovingGroup group = find_moving_group(current, cloud, by_near.T_cur_ref, params,
                                        std::min(kImpossiblePx, 3 * turn_sigma_px));
  if (group.points.empty()) return {};
  SE3 T_rest = by_near.T_cur_ref;
  align_edges(current, part_without(cloud, group.points), 0, params, &T_rest);
  const bool explains = by_near.square_to(T_rest) < kPulledSquare;
  return explains ? group : MovingGroup();
}

}  // namespace edgevo
