// SPDX-License-Identifier: BSD-3-Clause
#include "track_regression.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kNoLength = 1e-12;  // metres: added to residuals, where all are 0 none is displaced
constexpr double kNoSpread = 1e-9;   // units or metres: positions that are all the same fit any scale
// Of a step of the camera between two positions, relative: KITTI's are wrong by up to a tenth where a map is
// young or the view turns. Three of it are no jump of the sensor.
constexpr double kStepSigma = 0.1, kStepSigmas = 3;

Vectors means(const Vectors& points, const std::vector<int>& group, int groups) {
  Vectors sums(size_t(groups), Eigen::Vector3d::Zero());
  std::vector<double> counts(size_t(groups), 0.0);
  for (size_t i = 0; i < points.size(); ++i) sums[size_t(group[i])] += points[i], ++counts[size_t(group[i])];
  for (size_t g = 0; g < sums.size(); ++g)
    if (counts[g] > 0) sums[g] /= counts[g];
  return sums;
}

}  // namespace

TrackRegression::TrackRegression(const std::vector<TrackPair>& pairs, const Eigen::Vector3d& sensor_in_camera,
                                 double scale) {
  for (const TrackPair& pair : pairs) {
    source_.push_back(pair.T_world_cam.translation());
    if (scale > 0) source_.back() += pair.T_world_cam.R() * sensor_in_camera / scale;
    target_.push_back(pair.position);
  }
}

std::optional<GroupedFit> TrackRegression::fit(const std::vector<int>& group) const {
  const int groups = 1 + *std::max_element(group.begin(), group.end());
  const Vectors source_means = means(source_, group, groups), target_means = means(target_, group, groups);
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  double source_squares = 0, target_squares = 0;
  for (size_t i = 0; i < size(); ++i) {
    const Eigen::Vector3d s = source_[i] - source_means[size_t(group[i])],
                          t = target_[i] - target_means[size_t(group[i])];
    products += t * s.transpose();
    source_squares += s.squaredNorm(), target_squares += t.squaredNorm();
  }
  if (!(std::sqrt(source_squares) > kNoSpread) || !(std::sqrt(target_squares) > kNoSpread))
    return std::nullopt;
  GroupedFit fit;
  fit.spread = source_squares;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1;
  fit.R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  fit.scale = svd.singularValues().dot(signs) / source_squares;
  if (!(fit.scale > 0) || !std::isfinite(fit.scale)) return std::nullopt;
  for (int g = 0; g < groups; ++g)
    fit.offsets.push_back(target_means[size_t(g)] - fit.scale * (fit.R * source_means[size_t(g)]));
  for (size_t i = 0; i < size(); ++i) {
    fit.arms.push_back(fit.R * (source_[i] - source_means[size_t(group[i])]));
    fit.residuals.push_back(target_[i] - target_means[size_t(group[i])] - fit.scale * fit.arms.back());
  }
  return fit;
}

Vectors TrackRegression::residuals(const GroupedFit& fit, const std::vector<int>& group) const {
  Vectors residuals;
  for (size_t i = 0; i < size(); ++i)
    residuals.push_back(target_[i] - fit.offsets[size_t(group[i])] - fit.scale * (fit.R * source_[i]));
  return residuals;
}

bool TrackRegression::is_beyond_steps(const GroupedFit& fit, const std::vector<int>& group) const {
  for (size_t i = 1; i < size(); ++i) {
    if (group[i] == group[i - 1]) continue;
    const double step = fit.scale * (source_[i] - source_[i - 1]).norm();
    const double jump = (fit.offsets[size_t(group[i])] - fit.offsets[size_t(group[i - 1])]).norm();
    if (jump < kStepSigmas * kStepSigma * step) return false;
  }
  return true;
}

double autocorrelation(const Vectors& residuals) {
  double squares = 0, products = 0;
  for (size_t i = 0; i < residuals.size(); ++i) {
    squares += residuals[i].squaredNorm();
    if (i > 0) products += residuals[i].dot(residuals[i - 1]);
  }
  return squares > 0 ? std::clamp(products / squares, 0.0, 1.0) : 0.0;
}

double innovations(const Vectors& residuals) {
  const double rho = autocorrelation(residuals);
  double sum = residuals.front().squaredNorm() * (1 - rho * rho);
  for (size_t i = 1; i < residuals.size(); ++i) sum += (residuals[i] - rho * residuals[i - 1]).squaredNorm();
  return sum + double(residuals.size()) * kNoLength * kNoLength;
}

}  // namespace edgevo
