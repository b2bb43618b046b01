// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/closest_lens.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace edgevo {
namespace {

// A pixel with its ray.
struct Sample {
  Eigen::Vector2d px;
  Eigen::Vector3d ray;
  double angle() const { return std::atan2(ray.head<2>().norm(), ray.z()); }
};

std::vector<Sample> samples_of(const Camera& camera) {
  constexpr int kGrid = 50;  // a side, borders included
  const double max_angle = camera.max_angle();
  std::vector<Sample> samples;
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const Eigen::Vector2d px(i * (camera.width - 1.0) / kGrid, j * (camera.height - 1.0) / kGrid);
      const auto ray = camera.unproject(px);
      if (!ray) continue;
      const Sample sample{px, *ray};
      if (sample.angle() <= max_angle) samples.push_back(sample);
    }
  return samples;
}

}  // namespace

ClosestLens closest_kannala_brandt(const Camera& camera) {
  ClosestLens closest{camera, 0};
  if (std::holds_alternative<KannalaBrandtModel>(camera.model)) return closest;
  const Pinhole p = camera.pinhole();
  const std::vector<Sample> samples = samples_of(camera);
  Eigen::Matrix4d A = Eigen::Matrix4d::Identity() * 1e-12;  // of an image that shows almost nothing
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (const Sample& s : samples) {
    const double t = s.angle(), t2 = t * t, t3 = t * t2;
    const double r = std::hypot((s.px.x() - p.cx) / p.fx, (s.px.y() - p.cy) / p.fy);
    const Eigen::Vector4d powers(t3, t3 * t2, t3 * t2 * t2, t3 * t2 * t2 * t2);
    A += powers * powers.transpose();
    b += powers * (r - t);
  }
  const Eigen::Vector4d k = A.ldlt().solve(b);
  closest.camera.model = KannalaBrandtModel{{}, k[0], k[1], k[2], k[3]};
  closest.camera.set_pinhole(p);
  for (const Sample& s : samples)
    if (const auto px = closest.camera.project(s.ray))
      closest.max_error_px = std::max(closest.max_error_px, (*px - s.px).norm());
  return closest;
}

}  // namespace edgevo
