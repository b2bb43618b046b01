// SPDX-License-Identifier: BSD-3-Clause
#include "straight_rows.h"

#include <Eigen/SVD>
#include <algorithm>
#include <utility>

#include "edgevo/core/se3.h"
#include "edgevo/edges/image_correction.h"

namespace edgevo {
namespace {

using Rays = std::vector<Eigen::Vector3d>;

Rays unit_rays(const Pinhole& pinhole, const Corners& corners) {
  Rays rays;
  for (const cv::Point2f& c : corners) rays.push_back(pinhole.ray({c.x, c.y}).normalized());
  return rays;
}

// The rotation R that minimises the sum of |R a - b|, by reweighted least squares (Kabsch): corners on near
// things, which parallax moves by more, count less.
Eigen::Matrix3d rotation_between(const Rays& a, const Rays& b, double noise) {
  constexpr int kRounds = 8;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (size_t i = 0; i < a.size(); ++i) sum += b[i] * a[i].transpose() / ((R * a[i] - b[i]).norm() + noise);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d handed(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
    R = svd.matrixU() * handed.asDiagonal() * svd.matrixV().transpose();
  }
  return R;
}

// Rates at which the camera turns between successive views, radians per second; 0 where they have one time.
std::vector<Eigen::Vector3d> rates_between(const Pinhole& pinhole, const std::vector<Timestamp>& times,
                                           const std::vector<Corners>& views) {
  std::vector<Eigen::Vector3d> rates;
  Rays before = unit_rays(pinhole, views.front());
  for (size_t v = 1; v < views.size(); ++v) {
    Rays now = unit_rays(pinhole, views[v]);
    const double seconds = seconds_between(times[v - 1], times[v]);
    const Eigen::Matrix3d R = rotation_between(before, now, 1 / pinhole.fx);
    rates.push_back(seconds > 0 ? Eigen::Vector3d(SE3(R, {0, 0, 0}).log().tail<3>() / seconds)
                                : Eigen::Vector3d(0, 0, 0));
    before = std::move(now);
  }
  return rates;
}

// At view v; rates[v] lies between it and the next one.
Eigen::Vector3d rate_at(size_t v, const std::vector<Eigen::Vector3d>& rates) {
  const size_t n = rates.size();
  if (v > 0 && v < n) return (rates[v - 1] + rates[v]) / 2;
  const Eigen::Vector3d& near = v == 0 ? rates.front() : rates.back();
  const Eigen::Vector3d& next = v == 0 ? rates[std::min<size_t>(1, n - 1)] : rates[n > 1 ? n - 2 : 0];
  return near + (near - next) / 2;
}

}  // namespace

std::vector<ImageMotion> turning_motions(const Pinhole& pinhole, const std::vector<Timestamp>& times,
                                         const std::vector<Corners>& views) {
  const std::vector<Eigen::Vector3d> rates = rates_between(pinhole, times, views);
  std::vector<ImageMotion> motions(views.size());
  for (size_t v = 0; v < views.size(); ++v) motions[v].velocity.tail<3>() = rate_at(v, rates);
  return motions;
}

std::vector<Corners> straighten_rows(const Rectification& rectification, double row_time_s,
                                     const std::vector<ImageMotion>& motions,
                                     const std::vector<Corners>& views) {
  const Pinhole& pinhole = rectification.target();
  const ImageCorrection rolling{0, row_time_s};
  std::vector<Corners> straight = views;
  for (size_t v = 0; v < views.size(); ++v) {
    if (!motions[v].is_known()) continue;
    for (cv::Point2f& c : straight[v]) {
      const Eigen::Vector2d x = pinhole.ray({c.x, c.y}).head<2>();
      const Eigen::Vector2d at_middle = from_file(rectification, rolling, motions[v], x);
      const Eigen::Vector2d px = pinhole.project({at_middle.x(), at_middle.y(), 1});
      c = {float(px.x()), float(px.y())};
    }
  }
  return straight;
}

}  // namespace edgevo
