// SPDX-License-Identifier: BSD-3-Clause
#include "view_change.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/projection.h"

namespace edgevo {

namespace {

// Calls f(projection in a, projection in b) for each point.
template <class F>
void for_both(const Pinhole& pinhole, const std::vector<CloudPoint>& points, const SE3& T_a, const SE3& T_b,
              const F& f) {
  const Eigen::Matrix3d R_a = T_a.R(), R_b = T_b.R();
  for (const CloudPoint& p : points)
    f(project(pinhole, R_a, T_a.translation(), p.ray, p.idepth),
      project(pinhole, R_b, T_b.translation(), p.ray, p.idepth));
}

// Accumulates the mean square of image motions.
struct FlowSum {
  double square = 0;
  int counted = 0;

  void add(const Projection& a, const Projection& b) {
    square += (b.px - a.px).squaredNorm();
    ++counted;
  }
  double rms() const { return counted > 0 ? std::sqrt(square / counted) : 0; }
};

}  // namespace

double rms_flow_px(const Pinhole& pinhole, const std::vector<CloudPoint>& points, const SE3& T_a,
                   const SE3& T_b) {
  FlowSum flow;
  for_both(pinhole, points, T_a, T_b, [&](const Projection& a, const Projection& b) {
    if (a.valid && b.valid && pinhole.contains(a.px)) flow.add(a, b);
  });
  return flow.rms();
}

std::optional<ViewChange> view_change(const Pinhole& pinhole, const std::vector<CloudPoint>& points,
                                      const SE3& T_to_from) {
  const SE3 turn(T_to_from.rotation(), Eigen::Vector3d::Zero());
  FlowSum flow;
  int in_view = 0;
  for_both(pinhole, points, turn, T_to_from, [&](const Projection& turned, const Projection& moved) {
    if (moved.valid && pinhole.contains(moved.px)) ++in_view;
    if (turned.valid && moved.valid) flow.add(turned, moved);
  });
  if (flow.counted == 0) return std::nullopt;
  return ViewChange{flow.rms(), double(in_view) / double(points.size())};
}

std::vector<CloudPoint> visible_points(const Pinhole& pinhole, const ReferenceCloud& cloud,
                                       const SE3& T_cam_ref, size_t count) {
  std::vector<CloudPoint> seen;
  const size_t step = std::max<size_t>(1, cloud.points.size() / count);
  for (size_t i = 0; i < cloud.points.size(); i += step) {
    CloudPoint p = cloud.points[i];
    const Eigen::Vector3d Y = T_cam_ref.R() * p.ray + p.idepth * T_cam_ref.translation();
    if (!(Y.z() > kMinProjectedDepth) || !pinhole.contains(pinhole.project(Y))) continue;
    p.idepth /= Y.z();
    p.ray = Y / Y.z();
    seen.push_back(p);
  }
  return seen;
}

}  // namespace edgevo
