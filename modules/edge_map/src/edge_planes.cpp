// SPDX-License-Identifier: BSD-3-Clause
#include "edge_planes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "edgevo/core/random.h"
#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

constexpr int kTries = 200;      // a plane with a third of the samples is hit by half of them with 97.5 %
constexpr int kDraws = 4;        // for each sample of the other half, of which the most certain is taken
constexpr size_t kAtLeast = 40;  // samples: fewer lie on one by chance, of some 3000
constexpr size_t kCandidates = 1000;  // samples that a plane is looked for in: neighbours say the same
constexpr double kPlaneSigmas = 3;
constexpr double kRelief = 0.005;  // share of the inverse depth that a sample may be off the plane at first
constexpr int kRefinements = 3;
// Radius of the bends of what passes as a plane, in distances from the camera: over twenty distances, such a
// road leaves its tangent by 4 %.
constexpr double kBend = 5000;
constexpr int kMostPlanes = 3;  // a road, and what stands or lies along it; of the third, 6 in 10 are right
constexpr int kAreaPx = 32;     // side of the cells by which the area of a plane is counted
constexpr int kAreaColumns = 256;  // of these cells: more than any image has

Eigen::Vector3d homogeneous(const Eigen::Vector2d& px) { return {px.x(), px.y(), 1}; }

// Samples as the search for a plane needs them.
class Candidates {
 public:
  explicit Candidates(const std::vector<PlaneSample>& samples) {
    const size_t step = 1 + samples.size() / kCandidates;
    for (size_t i = 0; i < samples.size(); i += step) add(samples[i]);
    number_cells();
    area_of_.resize(size()), cells_.resize(size_t(cell_count_));
  }

  size_t size() const { return idepth_.size(); }
  Eigen::Vector3d x(size_t i) const { return {x_[i], y_[i], 1}; }
  double idepth(size_t i) const { return idepth_[i]; }
  double certainty(size_t i) const { return certainty_[i]; }

  static double inverse_sigma(const PlaneSample& s) {
    return 1 / std::sqrt(s.variance() + kRelief * kRelief * s.idepth * s.idepth);
  }

  // The area of the image that those near a plane cover: a dense thicket counts no more than its area, and an
  // uncertain sample, which lies on any plane, less than a certain one.
  double covered_area(const Eigen::Vector3d& plane) {
    weigh_areas(plane.x(), plane.y(), plane.z(), size(), x_.data(), y_.data(), idepth_.data(),
                inverse_sigma_.data(), certainty_.data(), area_of_.data());
    std::fill(cells_.begin(), cells_.end(), 0);
    for (size_t i = 0; i < size(); ++i) {
      double& cell = cells_[size_t(cell_[i])];
      cell = std::max(cell, area_of_[i]);
    }
    return std::accumulate(cells_.begin(), cells_.end(), 0.0);
  }

 private:
  void add(const PlaneSample& s) {
    x_.push_back(s.px.x()), y_.push_back(s.px.y()), idepth_.push_back(s.idepth);
    inverse_sigma_.push_back(inverse_sigma(s));
    certainty_.push_back(kRelief * s.idepth * inverse_sigma_.back());
    cell_.push_back(int(s.px.y()) / kAreaPx * kAreaColumns + int(s.px.x()) / kAreaPx);
  }
  // From 0 on, in their order.
  void number_cells() {
    std::vector<int> used = cell_;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (int& cell : cell_) cell = int(std::lower_bound(used.begin(), used.end(), cell) - used.begin());
    cell_count_ = int(used.size());
  }

  // The sum of the three products in Eigen's order.
  EDGEVO_WIDE_CLONES static void weigh_areas(double a, double b, double c, size_t count, const double* x,
                                             const double* y, const double* idepth,
                                             const double* inverse_sigma, const double* certainty,
                                             double* area) {
    for (size_t i = 0; i < count; ++i) {
      const double off = std::abs(idepth[i] - (a * x[i] + (b * y[i] + c))) * inverse_sigma[i] / kPlaneSigmas;
      area[i] = off < 1 ? (1 - off * off) * certainty[i] : 0;
    }
  }

  std::vector<double> x_, y_, idepth_, inverse_sigma_;
  std::vector<double> certainty_;  // 0 to 1
  std::vector<int> cell_;
  int cell_count_ = 0;
  std::vector<double> area_of_, cells_;  // of the last plane
};

// The most certain of a few: a plane through three samples has all their errors. Wrong ones may be the more
// certain, so that half of the planes are drawn without.
size_t certain_one(const Candidates& samples, int draws, Random* random) {
  const auto draw = [&] { return size_t(random->below(int(samples.size()))); };
  size_t best = draw();
  for (int i = 1; i < draws; ++i)
    if (const size_t other = draw(); samples.certainty(other) > samples.certainty(best)) best = other;
  return best;
}

// The best of many planes through three samples, if it covers more than `most`.
std::optional<Eigen::Vector3d> largest_plane(Candidates* samples, double most, Random* random) {
  std::optional<Eigen::Vector3d> best;
  for (int t = 0; t < kTries; ++t) {
    Eigen::Matrix3d M;
    Eigen::Vector3d y;
    for (int k = 0; k < 3; ++k) {
      const size_t s = certain_one(*samples, t % 2 == 0 ? kDraws : 1, random);
      M.row(k) = samples->x(s).transpose(), y[k] = samples->idepth(s);
    }
    constexpr double kLeastArea = 400;  // square pixels: a smaller triangle extrapolates its errors
    if (std::abs(M.determinant()) < 2 * kLeastArea) continue;
    const Eigen::Vector3d plane = M.inverse() * y;
    const double area = samples->covered_area(plane);
    if (area > most) most = area, best = plane;
  }
  return best;
}

}  // namespace

EdgePlane::EdgePlane(const std::vector<PlaneSample>& samples) {
  if (samples.size() < kAtLeast) return;
  for (const PlaneSample& s : samples) centre_ += s.px / double(samples.size());
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero(), shared = Eigen::Vector3d::Zero();
  for (const PlaneSample& s : samples) {
    const Eigen::Vector3d x = homogeneous(s.px - centre_);
    const double w = 1 / s.variance();
    A += w * x * x.transpose(), b += w * s.idepth * x, shared += w * s.common * x;
  }
  constexpr double kRounding = 1e-12;  // of a 3x3 system: samples on a line
  const Eigen::LDLT<Eigen::Matrix3d> solver(A);
  if (solver.info() != Eigen::Success ||
      !(solver.vectorD().minCoeff() > kRounding * solver.vectorD().maxCoeff()))
    return;
  plane_ = solver.solve(b);
  const Eigen::Vector3d bias = solver.solve(shared);
  covariance_ = solver.solve(Eigen::Matrix3d::Identity()) + bias * bias.transpose();
  measure_relief(samples);
  is_valid_ = true;
}

// What the samples are off the plane beyond their own errors.
void EdgePlane::measure_relief(const std::vector<PlaneSample>& samples) {
  double squares = 0, weights = 0;
  for (const PlaneSample& s : samples) {
    const double off = s.idepth - plane_.dot(homogeneous(s.px - centre_)), w = 1 / s.variance();
    squares += w * (off * off - s.variance()), weights += w * s.idepth * s.idepth;
  }
  relief_ = std::sqrt(std::max(0.0, squares / weights));
}

PlaneDepth EdgePlane::at(const Eigen::Vector2d& px) const {
  const Eigen::Vector3d x = homogeneous(px - centre_);
  const double idepth = plane_.dot(x);
  return {idepth, std::sqrt(x.dot(covariance_ * x) + std::pow(relief_ * idepth, 2))};
}

EdgePlane EdgePlane::about(const Eigen::Vector2d& centre) const {
  Eigen::Matrix3d M = Eigen::Matrix3d::Identity();  // from pixels about the new centre
  M.topRightCorner<2, 1>() = centre - centre_;
  EdgePlane same = *this;
  same.centre_ = centre, same.plane_ = M.transpose() * plane_;
  same.covariance_ = M.transpose() * covariance_ * M;
  return same;
}

EdgePlane EdgePlane::seen_from(const Pinhole& c, const SE3& T_before_now) const {
  EdgePlane now = about({c.cx, c.cy});
  const Eigen::DiagonalMatrix<double, 3> K(c.fx, c.fy, 1);
  // Its points X have q.X = 1: q is the normal over the distance.
  const Eigen::Vector3d q = K * now.plane_, t = T_before_now.translation();
  const Eigen::Matrix3d back = T_before_now.R().transpose();
  const double nearer = 1 - q.dot(t), distance = 1 / q.norm();
  const Eigen::Vector3d q_now = back * q / nearer, normal = q_now.normalized();
  const Eigen::Matrix3d J = back * (Eigen::Matrix3d::Identity() + q * t.transpose() / nearer) / nearer;
  const double turn = t.norm() / (kBend * distance), sink = turn * t.norm() / (2 * distance);
  const Eigen::Matrix3d along = normal * normal.transpose(),
                        bend = turn * turn * (Eigen::Matrix3d::Identity() - along) + sink * sink * along;
  const Eigen::Matrix3d Q = J * (K * now.covariance_ * K) * J.transpose() + q_now.squaredNorm() * bend;
  now.plane_ = K.inverse() * q_now, now.covariance_ = K.inverse() * Q * K.inverse();
  now.is_valid_ = is_valid_ && nearer > 0;
  return now;
}

Eigen::Vector3d EdgePlane::coefficients() const { return about(Eigen::Vector2d::Zero()).plane_; }

EdgePlane EdgePlane::scaled(double ratio) const {
  EdgePlane same = *this;
  same.plane_ /= ratio, same.covariance_ /= ratio * ratio;
  return same;
}

EdgePlane EdgePlane::corrected(const std::vector<PlaneSample>& samples) const {
  EdgePlane now = *this;
  for (int i = 0; i < kRefinements && now.is_valid_; ++i) {
    std::vector<PlaneSample> on;
    for (const PlaneSample& s : samples)
      if (now.holds(s)) on.push_back(s);
    now = EdgePlane(on);
    if (!now.is_valid_) break;
    const EdgePlane before = about(now.centre_);
    const Eigen::Matrix3d gain = before.covariance_ * (before.covariance_ + now.covariance_).inverse();
    now.plane_ = before.plane_ + gain * (now.plane_ - before.plane_);
    now.covariance_ = before.covariance_ - gain * before.covariance_;
    now.measure_relief(on);
  }
  return now;
}

bool EdgePlane::holds(const PlaneSample& sample) const {
  const Eigen::Vector3d x = homogeneous(sample.px - centre_);
  const double idepth = plane_.dot(x);
  const double variance =
      x.dot(covariance_ * x) + std::pow(std::max(kRelief, relief_) * idepth, 2) + sample.variance();
  const double off = sample.idepth - idepth;
  return idepth > 0 && off * off < kPlaneSigmas * kPlaneSigmas * variance;
}

EdgePlane refined(EdgePlane plane, const std::vector<PlaneSample>& samples) {
  for (int i = 0; i < kRefinements && plane.is_valid(); ++i) {
    std::vector<PlaneSample> on;
    for (const PlaneSample& s : samples)
      if (plane.holds(s)) on.push_back(s);
    plane = EdgePlane(on);
  }
  return plane;
}

namespace {

// A plane with its place among those predicted; -1: it is new.
struct LargestPlane {
  EdgePlane plane;
  int predicted;
};

LargestPlane find_largest(const std::vector<PlaneSample>& samples, const std::vector<EdgePlane>& predicted) {
  LargestPlane best{EdgePlane({}), -1};
  if (samples.size() < kAtLeast) return best;
  Random random(1);
  Candidates candidates(samples);
  double most = 0;
  for (size_t i = 0; i < predicted.size(); ++i)
    if (const EdgePlane now = predicted[i].corrected(samples); now.is_valid())
      if (const double area = candidates.covered_area(now.coefficients()); area > most)
        most = area, best = {predicted[i], int(i)};
  const std::optional<Eigen::Vector3d> larger = largest_plane(&candidates, most, &random);
  if (!larger) return best;
  std::vector<PlaneSample> near;
  for (const PlaneSample& s : samples)
    if (std::abs(s.idepth - larger->dot(homogeneous(s.px))) * Candidates::inverse_sigma(s) < kPlaneSigmas)
      near.push_back(s);
  const EdgePlane plane = refined(EdgePlane(near), samples);
  return plane.is_valid() ? LargestPlane{plane, -1} : best;
}

}  // namespace

std::vector<FoundPlane> find_planes(std::vector<PlaneSample> samples, std::vector<EdgePlane> predicted) {
  std::vector<FoundPlane> planes;
  while (int(planes.size()) < kMostPlanes) {
    const LargestPlane found = find_largest(samples, predicted);
    if (!found.plane.is_valid()) break;
    const bool is_predicted = found.predicted >= 0;
    planes.push_back({found.plane, is_predicted});
    if (is_predicted) predicted.erase(predicted.begin() + found.predicted);
    const EdgePlane now = is_predicted ? found.plane.corrected(samples) : found.plane;
    const auto is_taken = [&](const PlaneSample& s) { return now.holds(s); };
    samples.erase(std::remove_if(samples.begin(), samples.end(), is_taken), samples.end());
  }
  return planes;
}

}  // namespace edgevo
