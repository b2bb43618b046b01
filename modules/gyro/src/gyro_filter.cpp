// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/gyro/gyro_filter.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo {
namespace {

// Seconds between two changes of one kind.
constexpr double kBetweenChanges = 1000;
// Odds against all else at which a change is sure.
constexpr double kSureOdds = 100;
// A rival that has not won so many seconds after its beginning begins anew: a large change is seen within
// some images, a small one within seconds.
constexpr double kLives[] = {0.3, 3};
// Share of the rotations of images that are outliers, and of half of these the variance over that of the
// others.
constexpr double kOutliers = 0.02, kOutlierVariance = 100;

constexpr GyroChangeKind kKinds[] = {GyroChangeKind::kBias, GyroChangeKind::kScale, GyroChangeKind::kClock,
                                     GyroChangeKind::kMount, GyroChangeKind::kAll};

// Standard deviation of what may change at once: a chip that warms up or is hit, another range of its rates
// or an axis that is mirrored, buffers that are late, a holder that slips; or all of it.
GyroChange opened(GyroChangeKind kind) {
  constexpr double kBias = rad(3), kScale = 1, kOffset = 0.05, kDrift = 1e-3, kMount = rad(10);
  GyroChange sigma = GyroChange::Zero();
  const auto opens = [&](GyroChangeKind one) { return kind == one || kind == GyroChangeKind::kAll; };
  if (opens(GyroChangeKind::kBias)) sigma.segment<3>(kGyroBias).setConstant(kBias);
  if (opens(GyroChangeKind::kScale)) sigma.segment<3>(kGyroScale).setConstant(kScale);
  if (opens(GyroChangeKind::kClock)) sigma[kGyroOffset] = kOffset, sigma[kGyroDrift] = kDrift;
  if (opens(GyroChangeKind::kMount)) sigma.head<3>().setConstant(kMount);
  return sigma;
}

// Rates of a gyro that does not turn with the camera differ by this, rad/s: a hand or a robot that turns.
constexpr double kOtherRate = 1;
// Seconds for which it does not.
constexpr double kBroken = 1;

// Logarithms of how likely a rotation was, and how likely if the gyro does not turn with the camera.
struct Likelihood {
  double known, broken;
};

// log(e^a + e^b)
double log_sum(double a, double b) { return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b))); }

// The update by a rotation; nothing where samples are missing.
std::optional<Likelihood> update(const GyroIntegrator& gyro, const SeenTurn& seen, double factor,
                                 GyroModel* model) {
  const std::optional<CameraTurn> shown = camera_turn(gyro, *model, seen.begin, seen.end);
  if (!shown) return std::nullopt;
  const Eigen::Vector3d beyond = rotation_vector(seen.R * shown->R.conjugate());
  const GyroJacobian& J = shown->by_unknowns;
  GyroCovariance& P = model->covariance;
  const Eigen::Matrix3d S = J * P * J.transpose() + factor * (shown->noise + seen.covariance);
  const Eigen::Matrix3d information = S.inverse();
  const double square = beyond.dot(information * beyond), spread = std::log(S.determinant());
  if (!std::isfinite(square + spread)) return std::nullopt;
  const double other = kOtherRate * (seen.end - seen.begin);
  const Eigen::Matrix3d wide = S + other * other * Eigen::Matrix3d::Identity();
  const double broken = -0.5 * beyond.dot(wide.inverse() * beyond) - 0.5 * std::log(wide.determinant());
  // An image that is wrong is off a little more often than the rest, or as far as a gyro that is broken.
  const double inlier = std::log(1 - kOutliers) - 0.5 * square,
               near = -0.5 * square / kOutlierVariance - 1.5 * std::log(kOutlierVariance),
               outlier = std::log(kOutliers / 2) + log_sum(near, broken + 0.5 * spread),
               both = log_sum(inlier, outlier), weight = std::exp(inlier - both);
  const Eigen::Matrix<double, kGyroUnknowns, 3> K = P * J.transpose() * information;
  const GyroChange step = K * beyond;
  model->move(weight * step);
  // Of the mixture of both: with the update, and without.
  P += weight * (1 - weight) * step * step.transpose() - weight * K * J * P;
  P = (0.5 * (P + P.transpose())).eval();
  return Likelihood{both - 0.5 * spread, broken};
}

}  // namespace

void GyroFilter::begin_rivals(const SeenTurn& seen) {
  const double change_now = std::log((seen.end - seen.begin) / kBetweenChanges);
  if (rivals_.empty())
    for (const GyroChangeKind kind : kKinds)
      for (const double life : kLives) rivals_.push_back({kind, {}, {}, life, -life, -1e9, 0});
  for (Rival& r : rivals_) {
    const bool wins = r.log_odds > r.first_log_odds;
    if (wins || seen.begin - r.since_s < r.life_s) continue;
    r.model = r.before = nominal_;
    r.model.covariance.diagonal() += opened(r.kind).cwiseAbs2();
    r.since_s = seen.begin;
    r.log_odds = r.first_log_odds = (r.kind == GyroChangeKind::kAll ? 2 : 1) * change_now;
  }
}

// The likeliest, if what it says has changed is likelier than all else together; so it is not while the
// gyro turns with something else.
const GyroFilter::Rival* GyroFilter::sure_rival() const {
  const auto best = std::max_element(rivals_.begin(), rivals_.end(),
                                     [](const Rival& a, const Rival& b) { return a.log_odds < b.log_odds; });
  double others = std::exp(-best->log_odds);
  others += broken_ / (1 - broken_) * std::exp(log_odds_of_all() - best->log_odds);
  for (const Rival& r : rivals_)
    if (r.kind != best->kind) others += std::exp(r.log_odds - best->log_odds);
  return kSureOdds * others < 1 ? &*best : nullptr;
}

std::optional<FoundGyroChange> GyroFilter::see(const GyroIntegrator& gyro, const SeenTurn& seen,
                                               double factor) {
  if (!(seen.end > seen.begin)) return std::nullopt;
  nominal_.go_on_to(seen.end);
  for (Rival& r : rivals_) r.model.go_on_to(seen.end);
  begin_rivals(seen);
  std::optional<FoundGyroChange> found;
  const double odds_before = log_odds_of_all();
  if (const std::optional<Likelihood> likelihood = update(gyro, seen, factor, &nominal_)) {
    for (Rival& r : rivals_) {
      const std::optional<Likelihood> of_rival = update(gyro, seen, factor, &r.model);
      if (of_rival) r.log_odds += of_rival->known - likelihood->known;
    }
    const double known = likelihood->known + log_odds_of_all() - odds_before;
    weigh_broken(seen.end - seen.begin, known - likelihood->broken);
    if (is_broken()) broken_until_s_ = seen.end;
    if (const Rival* sure = sure_rival()) {
      found = {sure->kind, sure->since_s, sure->before.change_to(sure->model)};
      nominal_ = sure->model;
      rivals_.clear();
    }
  }
  mix();
  return found;
}

double GyroFilter::variance_of_rate() const { return broken_ * kOtherRate * kOtherRate; }

// `log_ratio`: of the likelihood of a gyro that turns with the camera to that of one that does not.
void GyroFilter::weigh_broken(double dt, double log_ratio) {
  const double begins = dt / kBetweenChanges, ends = std::min(0.5, dt / kBroken);
  const double before = broken_ * (1 - ends) + (1 - broken_) * begins;
  broken_ = 1 / (1 + (1 - before) / before * std::exp(log_ratio));
}

// Of the filter and its rivals together, relative to the filter.
double GyroFilter::log_odds_of_all() const {
  double most = 0;
  for (const Rival& r : rivals_) most = std::max(most, r.log_odds);
  double sum = std::exp(-most);
  for (const Rival& r : rivals_) sum += std::exp(r.log_odds - most);
  return most + std::log(sum);
}

void GyroFilter::mix() {
  double most = 0, sum = 0;  // relative to the filter's own
  for (const Rival& r : rivals_) most = std::max(most, r.log_odds);
  GyroChange mean = GyroChange::Zero();
  GyroCovariance squares = GyroCovariance::Zero();
  const auto add = [&](const GyroModel& model, double log_odds) {
    const double weight = std::exp(log_odds - most);
    const GyroChange off = nominal_.change_to(model);
    sum += weight;
    mean += weight * off;
    squares += weight * (model.covariance + off * off.transpose());
  };
  add(nominal_, 0);
  for (const Rival& r : rivals_) add(r.model, r.log_odds);
  mean /= sum;
  mean_ = nominal_;
  mean_.move(mean);
  mean_.covariance = squares / sum - mean * mean.transpose();
}

std::string describe(const FoundGyroChange& change) {
  const auto three = [](const Eigen::Vector3d& v, double unit, int decimals) {
    return "(" + fixed(v.x() * unit, decimals) + ", " + fixed(v.y() * unit, decimals) + ", " +
           fixed(v.z() * unit, decimals) + ")";
  };
  const Eigen::Vector3d scale = change.by.segment<3>(kGyroScale);
  const std::string bias = "its bias has changed by " + three(change.by.segment<3>(kGyroBias), deg(1), 2) +
                           " degrees/s",
                    scales = (scale.minCoeff() < -1 ? "an axis is mirrored: " : "") +
                             ("its scales have changed by " + three(scale, 100, 0)) + " %",
                    clock = "its clock has jumped by " + fixed(1e3 * change.by[kGyroOffset], 1) + " ms",
                    mount = "it has turned by " + three(change.by.head<3>(), deg(1), 1) +
                            " degrees against the camera";
  switch (change.kind) {
    case GyroChangeKind::kBias:
      return bias;
    case GyroChangeKind::kScale:
      return scales;
    case GyroChangeKind::kClock:
      return clock;
    case GyroChangeKind::kMount:
      return mount;
    case GyroChangeKind::kAll:
      break;
  }
  return scales + ", " + mount;
}

}  // namespace edgevo
