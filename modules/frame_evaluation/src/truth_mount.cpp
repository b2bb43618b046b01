// SPDX-License-Identifier: BSD-3-Clause
#include "truth_mount.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr int kIterations = 8;
constexpr size_t kMinMotions = 50;
constexpr double kPrior = 0.01;             // share of the measurements: what they leave open stays zero
constexpr double kArmPrior = 1e-3;          // less than a turn of 2 degrees says about the arm
constexpr double kLargestTurn = M_PI / 12;  // more is another convention of axes, not a mount
constexpr double kMinGain = 2.0 / 3;        // of the median error
constexpr double kMaxTurnLoss = 1.1;        // of the median error of the rotations: they must fit as before
constexpr double kTurnNoise = 1e-4;         // radians
constexpr double kMinError = 1e-3;          // of the median length: no weight is infinite

struct Motion {
  SE3 camera, body;  // camera: in metres
};

double error_of(const Motion& m, const SE3& T_body_cam) {
  return ((T_body_cam * m.camera * T_body_cam.inverse()).translation() - m.body.translation()).norm();
}

// Angle between the rotations, radians: neither a scale nor a bad translation has a part in it.
double turn_error_of(const Motion& m, const SE3& T_body_cam) {
  const Eigen::Quaterniond R = T_body_cam.rotation();
  return (R * m.camera.rotation() * R.conjugate()).angularDistance(m.body.rotation());
}

double median_turn_error(const std::vector<Motion>& motions, const SE3& T_body_cam) {
  std::vector<double> errors;
  for (const Motion& m : motions) errors.push_back(turn_error_of(m, T_body_cam));
  return median(std::move(errors));
}

std::vector<double> errors_of(const std::vector<Motion>& motions, const SE3& T_body_cam) {
  std::vector<double> errors;
  for (const Motion& m : motions) errors.push_back(error_of(m, T_body_cam));
  return errors;
}

std::vector<Motion> motions_of(const RunWithTruth& run, const StepScale& scales, int ahead, int scale_steps,
                               int fewest_steps) {
  std::vector<Motion> motions;
  for (int i = 0; i + ahead < run.size(); ++i) {
    const int k = i + ahead;
    if (!run.is_comparable(i) || !run.is_comparable(k) || run.segment(i) != run.segment(k)) continue;
    const auto scale = scales.before(run.segment(i), i, scale_steps, fewest_steps);
    if (!scale) continue;
    const SE3 M = run.motion(i, k);
    motions.push_back({SE3(M.rotation(), M.translation() / *scale), run.true_motion(i, k)});
  }
  return motions;
}

// Rotation that takes the camera's directions and axes of rotation to those of the body.
Eigen::Matrix3d fit_rotation(const std::vector<Motion>& motions, const std::vector<double>& weights,
                             double length_m, const Eigen::Vector3d& arm) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  double total = 0;
  for (size_t i = 0; i < motions.size(); ++i) {
    const Motion& m = motions[i];
    const Eigen::Vector3d rest = m.body.translation() - arm + m.body.rotation() * arm;
    H += weights[i] * m.camera.translation() * rest.transpose();
    const Eigen::Vector3d w_cam = SE3(m.camera.rotation(), Eigen::Vector3d::Zero()).log().tail<3>();
    const Eigen::Vector3d w_body = SE3(m.body.rotation(), Eigen::Vector3d::Zero()).log().tail<3>();
    H += weights[i] * length_m * length_m * w_cam * w_body.transpose();
    total += weights[i] * length_m * length_m;
  }
  H += kPrior * total * Eigen::Matrix3d::Identity();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixV() * sign * svd.matrixU().transpose();
}

Eigen::Vector3d fit_arm(const std::vector<Motion>& motions, const std::vector<double>& weights,
                        const Eigen::Matrix3d& R) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double total = 0;
  for (size_t i = 0; i < motions.size(); ++i) {
    const Eigen::Matrix3d J = Eigen::Matrix3d::Identity() - motions[i].body.R();
    A += weights[i] * J.transpose() * J;
    b += weights[i] * J.transpose() * (motions[i].body.translation() - R * motions[i].camera.translation());
    total += weights[i];
  }
  A += kArmPrior * total * Eigen::Matrix3d::Identity();
  return A.ldlt().solve(b);
}

}  // namespace

SE3 truth_mount(const RunWithTruth& run, const StepScale& scales, int ahead, int scale_steps,
                int fewest_steps) {
  const std::vector<Motion> motions = motions_of(run, scales, ahead, scale_steps, fewest_steps);
  if (motions.size() < kMinMotions) return {};
  std::vector<double> lengths;
  for (const Motion& m : motions) lengths.push_back(m.body.translation().norm());
  const double length_m = median(std::move(lengths));
  const double before = median(errors_of(motions, {}));
  SE3 mount;
  for (int k = 0; k < kIterations; ++k) {
    std::vector<double> weights = errors_of(motions, mount);
    for (double& w : weights) w = 1 / std::max({w, kMinError * length_m, 1e-12});
    const Eigen::Matrix3d R = fit_rotation(motions, weights, length_m, mount.translation());
    mount = SE3(R, fit_arm(motions, weights, R));
  }
  const bool is_better = median(errors_of(motions, mount)) <= kMinGain * before;
  const bool is_usual = mount.is_finite() && mount.angle() <= kLargestTurn;
  if (!is_usual || !is_better) return {};
  const bool fits_turns =
      median_turn_error(motions, mount) <= kMaxTurnLoss * median_turn_error(motions, {}) + kTurnNoise;
  return fits_turns ? mount : SE3();
}

}  // namespace edgevo
