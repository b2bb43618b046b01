// SPDX-License-Identifier: BSD-3-Clause
#include "edge_planes.h"

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

constexpr int kTries = 100;      // a plane with a third of the samples is hit with 97.5 %
constexpr size_t kAtLeast = 40;  // samples: fewer lie on one by chance, of some 3000
constexpr double kPlaneSigmas = 3;
constexpr double kRelief = 0.005;  // share of the inverse depth that a sample may be off the plane at first
constexpr int kRefinements = 3;
constexpr int kAreaPx = 32;        // side of the cells by which the area of a plane is counted
constexpr int kAreaColumns = 256;  // of these cells: more than any image has

Eigen::Vector3d homogeneous(const Eigen::Vector2d& px) { return {px.x(), px.y(), 1}; }

// A sample as the search for a plane needs it.
struct Candidate {
  explicit Candidate(const PlaneSample& s)
      : x(homogeneous(s.px)),
        idepth(s.idepth),
        inverse_sigma(1 / std::hypot(s.sigma(), kRelief * s.idepth)),
        certainty(kRelief * s.idepth * inverse_sigma),
        cell(size_t(int(s.px.y()) / kAreaPx * kAreaColumns + int(s.px.x()) / kAreaPx)) {}

  // In standard deviations.
  double off(const Eigen::Vector3d& plane) const { return std::abs(idepth - plane.dot(x)) * inverse_sigma; }

  Eigen::Vector3d x;
  double idepth, inverse_sigma;
  double certainty;  // 0 to 1
  size_t cell;
};

// The area of the image that samples near a plane cover: a dense thicket counts no more than its area, and an
// uncertain sample, which lies on any plane, less than a certain one.
double covered_area(const std::vector<Candidate>& samples, const Eigen::Vector3d& plane,
                    std::vector<double>* cells) {
  std::fill(cells->begin(), cells->end(), 0);
  for (const Candidate& s : samples) {
    const double off = s.off(plane) / kPlaneSigmas;
    if (off >= 1) continue;
    if (s.cell >= cells->size()) cells->resize(s.cell + 1);
    (*cells)[s.cell] = std::max((*cells)[s.cell], (1 - off * off) * s.certainty);
  }
  return std::accumulate(cells->begin(), cells->end(), 0.0);
}

// The best of many planes through three samples.
Eigen::Vector3d largest_plane(const std::vector<Candidate>& samples, Random* random) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double most = 0;
  std::vector<double> cells;
  for (int t = 0; t < kTries; ++t) {
    Eigen::Matrix3d M;
    Eigen::Vector3d y;
    for (int k = 0; k < 3; ++k) {
      const Candidate& s = samples[size_t(random->below(int(samples.size())))];
      M.row(k) = s.x.transpose(), y[k] = s.idepth;
    }
    constexpr double kLeastArea = 400;  // square pixels: a smaller triangle extrapolates its errors
    if (std::abs(M.determinant()) < 2 * kLeastArea) continue;
    const Eigen::Vector3d plane = M.inverse() * y;
    const double area = covered_area(samples, plane, &cells);
    if (area > most) most = area, best = plane;
  }
  return best;
}

}  // namespace

double PlaneSample::sigma() const { return std::hypot(noise, common); }

EdgePlane::EdgePlane(const std::vector<PlaneSample>& samples) : size_(int(samples.size())) {
  if (samples.size() < kAtLeast) return;
  for (const PlaneSample& s : samples) centre_ += s.px / double(samples.size());
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero(), shared = Eigen::Vector3d::Zero();
  for (const PlaneSample& s : samples) {
    const Eigen::Vector3d x = homogeneous(s.px - centre_);
    const double w = 1 / (s.sigma() * s.sigma());
    A += w * x * x.transpose(), b += w * s.idepth * x, shared += w * s.common * x;
  }
  constexpr double kRounding = 1e-12;  // of a 3x3 system: samples on a line
  const Eigen::LDLT<Eigen::Matrix3d> solver(A);
  if (solver.info() != Eigen::Success ||
      !(solver.vectorD().minCoeff() > kRounding * solver.vectorD().maxCoeff()))
    return;
  plane_ = solver.solve(b), bias_ = solver.solve(shared);
  covariance_ = solver.solve(Eigen::Matrix3d::Identity());
  double squares = 0, weights = 0;
  for (const PlaneSample& s : samples) {
    const double off = s.idepth - plane_.dot(homogeneous(s.px - centre_)), w = 1 / (s.sigma() * s.sigma());
    squares += w * (off * off - s.sigma() * s.sigma()), weights += w * s.idepth * s.idepth;
  }
  relief_ = std::sqrt(std::max(0.0, squares / weights));
  is_valid_ = true;
}

PlaneDepth EdgePlane::at(const Eigen::Vector2d& px) const {
  const Eigen::Vector3d x = homogeneous(px - centre_);
  const double idepth = plane_.dot(x);
  return {idepth,
          std::sqrt(x.dot(covariance_ * x) + std::pow(bias_.dot(x), 2) + std::pow(relief_ * idepth, 2))};
}

bool EdgePlane::holds(const PlaneSample& sample) const {
  const PlaneDepth here = at(sample.px);
  return here.idepth > 0 &&
         std::abs(sample.idepth - here.idepth) < kPlaneSigmas * std::hypot(sample.sigma(), here.sigma);
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

EdgePlane find_plane(const std::vector<PlaneSample>& samples) {
  if (samples.size() < kAtLeast) return EdgePlane({});
  Random random(1);
  const std::vector<Candidate> candidates(samples.begin(), samples.end());
  const Eigen::Vector3d largest = largest_plane(candidates, &random);
  std::vector<PlaneSample> near;
  for (size_t i = 0; i < samples.size(); ++i)
    if (candidates[i].off(largest) < kPlaneSigmas) near.push_back(samples[i]);
  return refined(EdgePlane(near), samples);
}

}  // namespace edgevo
