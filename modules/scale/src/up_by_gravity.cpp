// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/up_by_gravity.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/robust.h"

namespace edgevo {
namespace {

constexpr double kPartS = 1;       // seconds: parts over which means are taken
constexpr double kSpeedS = 0.1;    // to each side of a time, from which its velocity is taken
constexpr double kGapS = 0.3;      // poses further apart do not say what was between them
constexpr size_t kLeastParts = 5;  // their equations, three each, are twice the seven unknowns
constexpr double kBias = 0.2;      // m/s^2: standard deviation, by the datasheets of telephones
constexpr double kLeastGravity = 8, kMostGravity = 12;  // m/s^2
constexpr double kMaxSigmaDeg = 1;                      // of an up that maps are levelled by

// The poses of a run by their times, seconds.
class PosesByTime {
 public:
  PosesByTime(const Run& run, Timestamp origin) {
    for (const FrameRecord& f : run.frames)
      if (f.T_world_cam && (points_.empty() || seconds_between(origin, f.time) > points_.back().t))
        points_.push_back({seconds_between(origin, f.time), f.segment, *f.T_world_cam});
  }
  bool empty() const { return points_.empty(); }
  double begin() const { return points_.front().t; }
  double end() const { return points_.back().t; }
  // Between two poses of one map; nothing in a gap.
  std::optional<SE3> at(double t) const {
    const auto after = std::upper_bound(points_.begin(), points_.end(), t,
                                        [](double time, const Point& p) { return time < p.t; });
    if (after == points_.begin() || after == points_.end()) return std::nullopt;
    const Point &a = *(after - 1), &b = *after;
    if (b.t - a.t > kGapS || a.segment != b.segment) return std::nullopt;
    const double share = (t - a.t) / (b.t - a.t);
    return SE3(a.T.rotation().slerp(share, b.T.rotation()),
               (1 - share) * a.T.translation() + share * b.T.translation());
  }
  // Of the camera, units a second.
  std::optional<Eigen::Vector3d> velocity(double t) const {
    const auto before = at(t - kSpeedS), after = at(t + kSpeedS);
    if (!before || !after) return std::nullopt;
    return Eigen::Vector3d((after->translation() - before->translation()) / (2 * kSpeedS));
  }

 private:
  struct Point {
    double t;
    int segment;
    SE3 T;
  };
  std::vector<Point> points_;
};

using Unknowns = Eigen::Matrix<double, 7, 1>;  // gravity, bias, length of a unit
using Square = Eigen::Matrix<double, 7, 7>;

// The means of a second.
struct Part {
  Eigen::Vector3d felt = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 7> J = Eigen::Matrix<double, 3, 7>::Zero();
};

struct Felt {
  double t;  // in the clock of the camera
  Eigen::Vector3d acceleration;
};

std::vector<Felt> felt_of(const std::vector<GyroSample>& samples, const GyroModel& gyro) {
  std::vector<Felt> felt;
  for (const GyroSample& s : samples) {
    const double t = seconds_between(samples.front().time, s.time);
    if (s.acceleration.allFinite() && !s.acceleration.isZero())
      felt.push_back({t - gyro.offset_at(t), s.acceleration});
  }
  std::sort(felt.begin(), felt.end(), [](const Felt& a, const Felt& b) { return a.t < b.t; });
  return felt;
}

// The means from `begin` on; nothing where the poses have a gap.
std::optional<Part> part_of(const PosesByTime& path, const std::vector<Felt>& felt,
                            const Eigen::Matrix3d& R_cam_gyro, double begin) {
  const auto v0 = path.velocity(begin), v1 = path.velocity(begin + kPartS);
  if (!v0 || !v1) return std::nullopt;
  Part part;
  Eigen::Matrix3d turned = Eigen::Matrix3d::Zero();
  int count = 0;
  auto next =
      std::lower_bound(felt.begin(), felt.end(), begin, [](const Felt& f, double t) { return f.t < t; });
  for (; next != felt.end() && next->t < begin + kPartS; ++next, ++count) {
    const auto pose = path.at(next->t);
    if (!pose) return std::nullopt;
    const Eigen::Matrix3d R = pose->R() * R_cam_gyro;
    part.felt += R * next->acceleration, turned += R;
  }
  if (count == 0) return std::nullopt;
  part.felt /= count;
  part.J << Eigen::Matrix3d::Identity(), turned / count, (*v1 - *v0) / kPartS;
  return part;
}

// All of them; seconds in which nothing was felt are not gone through.
std::vector<Part> parts_of(const PosesByTime& path, const std::vector<Felt>& felt,
                           const Eigen::Matrix3d& R_cam_gyro) {
  std::vector<Part> parts;
  double begin = path.begin() + kSpeedS;
  for (const Felt& f : felt) {
    if (f.t < begin) continue;
    if (f.t > begin + kPartS) begin += std::floor((f.t - begin) / kPartS) * kPartS;
    if (begin + kPartS + kSpeedS >= path.end()) break;
    if (const auto part = part_of(path, felt, R_cam_gyro, begin)) parts.push_back(*part);
    begin += kPartS;
  }
  return parts;
}

struct Solution {
  Unknowns x = Unknowns::Zero();
  Square covariance = Square::Zero();
};

// Reweighted least squares; what is left is as large as the median of the parts.
Solution solve(const std::vector<Part>& parts) {
  constexpr int kRounds = 6;
  constexpr double kHuberSigmas = 1.5, kMedianOfThree = 1.538;  // of the length of three unit normals
  Solution s;
  double sigma = 1;  // m/s^2
  for (int round = 0; round < kRounds; ++round) {
    Square H = Square::Zero();
    Unknowns b = Unknowns::Zero();
    H.diagonal().segment<3>(3).setConstant(1 / (kBias * kBias));
    for (const Part& p : parts) {
      const double off = (p.felt - p.J * s.x).norm() / sigma;
      const double w = (round == 0 ? 1 : huber_weight(off, kHuberSigmas)) / (sigma * sigma);
      H += w * p.J.transpose() * p.J;
      b += w * p.J.transpose() * p.felt;
    }
    H.diagonal().array() += 1e-9 * H.trace();
    s.covariance = H.ldlt().solve(Square::Identity());
    s.x = s.covariance * b;
    std::vector<double> off;
    for (const Part& p : parts) off.push_back((p.felt - p.J * s.x).norm());
    sigma = std::max(1e-3, median(std::move(off)) / kMedianOfThree);
  }
  return s;
}

}  // namespace

std::optional<UpEstimate> up_by_gravity(const Run& run, const std::vector<GyroSample>& samples,
                                        const GyroModel& gyro) {
  if (samples.empty()) return std::nullopt;
  const PosesByTime path(run, samples.front().time);
  if (path.empty()) return std::nullopt;
  const std::vector<Felt> felt = felt_of(samples, gyro);
  const std::vector<Part> parts = parts_of(path, felt, gyro.R_cam_gyro.toRotationMatrix());
  if (parts.size() < kLeastParts) return std::nullopt;
  const Solution s = solve(parts);
  const Eigen::Vector3d gravity = s.x.head<3>();
  if (!(gravity.norm() > kLeastGravity && gravity.norm() < kMostGravity)) return std::nullopt;
  UpEstimate up;
  up.up = gravity.normalized();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - up.up * up.up.transpose();
  const double sigma2 = (across * s.covariance.topLeftCorner<3, 3>() * across).trace() / 2;
  up.sigma_deg = deg(std::hypot(std::sqrt(sigma2) / gravity.norm(), gyro.rotation_sigma()));
  up.tilt_deg = deg(std::acos(std::clamp(-up.up.y(), -1.0, 1.0)));
  up.seen_in = "accelerometer";
  up.is_certain = up.sigma_deg < kMaxSigmaDeg;
  return up;
}

}  // namespace edgevo
