// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/similarity_fit.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace edgevo {
namespace {

constexpr int kMinPoints = 3;  // a similarity fits any two points exactly
// Share of the distance from the origin: closer points differ only by rounding.
constexpr double kCoincide = 1e-9;

}  // namespace

bool coincide(const Points& points) {
  const double reach = points.cwiseAbs().maxCoeff();
  return !(spread(points) > kCoincide * reach);
}

double spread(const Points& points) {
  if (points.cols() == 0) return 0;
  const Eigen::Vector3d mean = points.rowwise().mean();
  return std::sqrt((points.colwise() - mean).squaredNorm() / double(points.cols()));
}

std::optional<Sim3> fit_sim3(const Points& src, const Points& dst) {
  if (src.cols() < kMinPoints || coincide(src) || coincide(dst)) return std::nullopt;
  const Eigen::Matrix4d M = Eigen::umeyama(src, dst, true);
  const double scale = M.topLeftCorner<3, 1>().norm();
  if (!(scale > 0) || !std::isfinite(scale)) return std::nullopt;
  return Sim3{scale, SE3(Eigen::Matrix3d(M.topLeftCorner<3, 3>() / scale), M.topRightCorner<3, 1>())};
}

std::optional<Sim3> fit_se3(const Points& src, const Points& dst) {
  if (src.cols() < kMinPoints) return std::nullopt;
  const Eigen::Matrix4d M = Eigen::umeyama(src, dst, false);
  return Sim3{1.0, SE3(Eigen::Matrix3d(M.topLeftCorner<3, 3>()), M.topRightCorner<3, 1>())};
}

}  // namespace edgevo
