// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/gyro/gyro_calibration.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

#include "chi_square.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/robust.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo {
namespace {

// Logarithm of the odds from which something is sure: one in a million by chance.
constexpr double kSure = 14;
// One file of ten has left-handed axes, at most.
constexpr double kRarelyMirrored = 2.3;
// Clocks that are further apart are not searched for; nor is the offset finer than a sample first.
constexpr double kOffsetStepS = 0.01;
// Seconds: how far another clock is looked for, to name it.
constexpr double kOtherClockS = 10;
// A logarithm: rates of a gyro are off by a few per cent, those of degrees by 4.
constexpr double kSameRates = 0.2;
constexpr double kHuberSigmas = 2.5;

// How well both angular velocities agree at an offset.
struct Agreement {
  double offset = 0;
  int turns = 0;
  // Correlation with the best rotation, and with the best mirrored one.
  double proper = 0, mirrored = 0;
  double times = 1;   // rates of the images over those of the gyro
  Eigen::Matrix3d R;  // from the gyro to the camera
  double best() const { return std::max(proper, mirrored); }
};

// Logarithm of the odds that a share `b` of correlation explains the turns better than `a` does.
double log_odds(double a, double b, int turns) {
  const auto unexplained = [](double r) { return std::max(1e-12, 1 - r * r); };
  return 1.5 * turns * std::log(unexplained(a) / unexplained(b));
}

Agreement agreement_at(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns, double offset) {
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> rates;  // of the images, of the gyro
  Eigen::Vector3d mean_seen = Eigen::Vector3d::Zero(), mean_shown = Eigen::Vector3d::Zero();
  for (const SeenTurn& t : turns) {
    const auto shown = gyro.mean_rate(t.begin + offset, t.end + offset);
    if (!shown) continue;
    rates.emplace_back(-rotation_vector(t.R) / (t.end - t.begin), *shown);
    mean_seen += rates.back().first, mean_shown += rates.back().second;
  }
  Agreement a;
  a.offset = offset;
  a.turns = int(rates.size());
  if (rates.size() < 3) return a;
  mean_seen /= double(rates.size()), mean_shown /= double(rates.size());
  Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
  double seen = 0, shown = 0;
  for (auto& [w, m] : rates) {
    w -= mean_seen, m -= mean_shown;
    K += w * m.transpose();
    seen += w.squaredNorm(), shown += m.squaredNorm();
  }
  if (!(seen > 0) || !(shown > 0)) return a;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(K, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1;
  const Eigen::Vector3d s = svd.singularValues();
  a.proper = (s[0] + s[1] + sign * s[2]) / std::sqrt(seen * shown);
  a.mirrored = (s[0] + s[1] - sign * s[2]) / std::sqrt(seen * shown);
  a.times = (s[0] + s[1] + sign * s[2]) / shown;
  a.R = svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  return a;
}

Agreement best_agreement(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns, double most) {
  Agreement best;
  for (double offset = -most; offset <= most; offset += kOffsetStepS) {
    const Agreement a = agreement_at(gyro, turns, offset);
    // Turns that an offset leaves without samples do not count against it.
    if (a.turns > 0 && 2 * a.turns >= best.turns && a.best() > best.best()) best = a;
  }
  return best;
}

// What the best of all offsets up to `most` has in its favour.
double log_of_choices(double most) { return std::log(2 * most / kOffsetStepS); }

// Whether a gyro that does not turn with the camera, or only somehow, turns as it does at another time.
std::optional<GyroFit> other_clock(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns,
                                   const Agreement& same_clock) {
  const Agreement a = best_agreement(gyro, turns, kOtherClockS);
  const double odds = log_odds(same_clock.best(), a.best(), a.turns) - log_of_choices(kOtherClockS);
  if (odds < kSure || a.proper < a.mirrored || std::abs(std::log(a.times)) > kSameRates) return std::nullopt;
  GyroFit fit;
  fit.kind = GyroFit::Kind::kOtherClock;
  fit.offset_s = a.offset;
  return fit;
}

// Whether the images show more than their own noise.
bool turns_enough(const std::vector<SeenTurn>& turns) {
  double seen = 0, noise = 0;
  for (const SeenTurn& t : turns) seen += rotation_vector(t.R).squaredNorm(), noise += t.covariance.trace();
  constexpr double kTimesNoise = 10;  // covariances of images may be too small by half of that
  return seen > kTimesNoise * noise;
}

// Rotation that the images show beyond that of the gyro.
Eigen::Vector3d beyond(const SeenTurn& seen, const CameraTurn& shown) {
  return rotation_vector(seen.R * shown.R.conjugate());
}

struct Normal {
  GyroCovariance H = GyroCovariance::Zero();
  GyroChange g = GyroChange::Zero();
  std::vector<double> squares;  // of the residuals, in sigmas
  double together = 1;          // variance of sums of them over that of independent ones
};

// Turns whose errors are taken to go together: half a swing of a hand.
constexpr int kTogether = 10;

// `factor`: of the variances of turns.
Normal linearise(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns, const GyroModel& model,
                 double factor) {
  Normal n;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double sums2 = 0;
  for (const SeenTurn& seen : turns) {
    const auto shown = camera_turn(gyro, model, seen.begin, seen.end);
    if (!shown) continue;
    const Eigen::Matrix3d information = (shown->noise + seen.covariance).inverse();
    const Eigen::Vector3d r = beyond(seen, *shown);
    const double square = r.dot(information * r);
    n.squares.push_back(square);
    sum += information.llt().matrixU() * r;
    if (n.squares.size() % kTogether == 0) sums2 += sum.squaredNorm(), sum.setZero();
    const double w = huber_weight(std::sqrt(square / factor), kHuberSigmas) / factor;
    const GyroJacobian& J = shown->by_unknowns;
    n.H.noalias() += w * J.transpose() * information * J;
    n.g.noalias() += w * J.transpose() * (information * r);
  }
  const size_t blocks = n.squares.size() / kTogether;
  if (blocks > 0) n.together = sums2 / (3.0 * kTogether * double(blocks));
  return n;
}

}  // namespace

GyroModel refine_gyro(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns,
                      const GyroModel& start) {
  constexpr int kIterations = 6;  // the start is right to a few degrees and a sample
  const GyroCovariance prior = start.covariance.inverse();
  GyroChange moved = GyroChange::Zero();
  GyroModel model = start;
  double factor = 1;
  for (int i = 0; i < kIterations; ++i) {
    const Normal n = linearise(gyro, turns, model, factor);
    if (n.squares.empty()) return start;
    factor = std::max(1.0, median(n.squares) / kMedianChiSquare);
    // Errors that neighbours share, such as those of rows that are not straight yet, do not average out.
    const double shared = std::max(1.0, n.together / factor);
    const GyroCovariance H = n.H + prior;
    const GyroChange step = H.ldlt().solve(n.g - prior * moved);
    if (!step.allFinite()) return start;
    model.move(step);
    moved += step;
    model.covariance = (n.H / shared + prior).inverse();
  }
  return model;
}

namespace {

GyroFit fit_same_clock(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns, const Agreement& a) {
  GyroFit fit;
  if (a.turns < 3) return fit;
  fit.times = a.times;
  if (log_odds(0, a.best(), a.turns) < kSure + log_of_choices(kMostGyroOffsetS)) {
    constexpr int kEnough = 150;  // turns: five seconds of a camera that turns
    if (a.turns >= kEnough && turns_enough(turns)) fit.kind = GyroFit::Kind::kUnrelated;
    return fit;
  }
  if (const double odds = log_odds(a.proper, a.mirrored, a.turns); odds > kRarelyMirrored) {
    fit.kind = odds > kSure ? GyroFit::Kind::kMirrored : GyroFit::Kind::kPerhapsMirrored;
    return fit;
  }
  if (std::abs(std::log(a.times)) > kSameRates) {
    fit.kind = GyroFit::Kind::kOtherRates;
    return fit;
  }
  GyroModel start = gyro_before_use();
  start.R_cam_gyro = Eigen::Quaterniond(a.R).normalized();
  start.offset_s = a.offset;
  start.at_s = turns.back().end;
  fit.kind = GyroFit::Kind::kRelated;
  fit.model = refine_gyro(gyro, turns, start);
  return fit;
}

}  // namespace

GyroFit fit_gyro(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns) {
  const Agreement a = best_agreement(gyro, turns, kMostGyroOffsetS);
  const GyroFit fit = fit_same_clock(gyro, turns, a);
  const bool is_wrong = fit.kind != GyroFit::Kind::kUnknown && fit.kind != GyroFit::Kind::kRelated;
  return is_wrong ? other_clock(gyro, turns, a).value_or(fit) : fit;
}

}  // namespace edgevo
