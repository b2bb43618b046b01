// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/rolling_shutter.h"

#include <cmath>

namespace edgevo {
namespace {

using Cells = Eigen::Matrix<double, ImageMotion::kRows, ImageMotion::kColumns>;

// Weight of a neighbouring cell, in points: some 1500 points fall into 80 cells.
constexpr double kSmoothness = 10;
// Weight of the mean of all points in each cell, in points: it decides where there is none.
constexpr double kFaint = 0.5;
constexpr int kMinPoints = 50;  // in view; the mean of fewer is less reliable than the map's median
constexpr int kSweeps = 60;     // of the Gauss-Seidel method: depths are smooth by then

// The point times its inverse depth, in the current camera.
Eigen::Vector3d in_current(const SE3& T_cur_ref, const CloudPoint& p) {
  return T_cur_ref.R() * p.ray + p.idepth * T_cur_ref.translation();
}

// Inverse depths of cells from the points in them: least squares with differences between neighbours.
Cells smooth_cells(const Cells& sum, const Cells& count, double mean) {
  Cells idepth = Cells::Constant(mean);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (int y = 0; y < idepth.rows(); ++y)
      for (int x = 0; x < idepth.cols(); ++x) {
        double value = sum(y, x) + kFaint * mean, weight = count(y, x) + kFaint;
        const auto add = [&](int v, int u) {
          if (v >= 0 && v < idepth.rows() && u >= 0 && u < idepth.cols())
            value += kSmoothness * idepth(v, u), weight += kSmoothness;
        };
        add(y - 1, x), add(y + 1, x), add(y, x - 1), add(y, x + 1);
        idepth(y, x) = value / weight;
      }
  return idepth;
}

}  // namespace

ImageMotion image_motion(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                         const Vector6d& twist, double median_idepth) {
  ImageMotion motion;
  motion.velocity = twist;
  Cells sum = Cells::Zero(), count = Cells::Zero();
  for (const CloudPoint& p : cloud.points) {
    if (p.host_keyframe < 0) continue;  // its depth has not converged yet
    const Eigen::Vector3d Y = in_current(T_cur_ref, p);
    if (!(Y.z() > 0.1)) continue;
    const Eigen::Vector2d px = pinhole.project(Y);
    if (!pinhole.contains(px)) continue;
    const int row = int(px.y() / pinhole.height * ImageMotion::kRows),
              column = int(px.x() / pinhole.width * ImageMotion::kColumns);
    sum(row, column) += p.idepth / Y.z();
    count(row, column) += 1;
  }
  motion.idepth =
      smooth_cells(sum, count, count.sum() < kMinPoints ? median_idepth : sum.sum() / count.sum());
  return motion;
}

ReferenceCloud shift_cloud(const Rectification& rectification, const ReferenceCloud& cloud,
                           const SE3& T_cur_ref, double row_time_s, const ImageMotion& expected,
                           const ImageMotion& measured) {
  const Pinhole& pinhole = rectification.target();
  ReferenceCloud shifted;
  shifted.pyramid = cloud.pyramid;
  shifted.points = cloud.points;
  const Eigen::Matrix3d R_ref_cur = T_cur_ref.R().transpose();
  for (CloudPoint& p : shifted.points) {
    Eigen::Vector3d Y = in_current(T_cur_ref, p);
    if (!(Y.z() > 0)) continue;
    const Eigen::Vector2d x = Y.head<2>() / Y.z();
    if (!pinhole.contains(pinhole.project(Y))) continue;
    const Eigen::Vector2d left = add_rolling(rectification, row_time_s, measured, x) -
                                 add_rolling(rectification, row_time_s, expected, x);
    Y.head<2>() += Y.z() * left;
    const Eigen::Vector3d back = R_ref_cur * (Y - p.idepth * T_cur_ref.translation());
    if (!(back.z() > 0)) continue;
    p.ray = back / back.z();
    p.idepth /= back.z();
  }
  return shifted;
}

Eigen::Vector3d shift_ray(const Rectification& rectification, double row_time_s, const ImageMotion& expected,
                          const ImageMotion& measured, const Eigen::Vector3d& ray) {
  const Eigen::Vector2d x = ray.head<2>();
  const Eigen::Vector2d left = add_rolling(rectification, row_time_s, expected, x) -
                               add_rolling(rectification, row_time_s, measured, x);
  return {x.x() + left.x(), x.y() + left.y(), 1.0};
}

}  // namespace edgevo
