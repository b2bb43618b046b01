// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/gyro/gyro_aid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "chi_square.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo {
namespace {

// Turns after which a fit is tried first, and the factor to the next try: a run pays for few of them.
constexpr size_t kFirstTurns = 30;
constexpr double kTurnsFactor = 1.4;
constexpr size_t kMostTurns = 300;  // of a fit: ten seconds
// Turns that its worth is measured from: two seconds, since images are wrong for some frames more often than
// gyros are.
constexpr size_t kCompared = 60;
// A gyro whose errors are twice those of going on as before is not used.
constexpr double kWorse = 4;  // of squares
constexpr double kDegrees = rad(1);

std::string formatted_degrees(const char* format, double a, double b) {
  char text[200];
  std::snprintf(text, sizeof text, format, deg(a), deg(b));
  return text;
}

}  // namespace

GyroAid::GyroAid(const std::optional<GyroModel>& known) : next_calibration_(kFirstTurns) {
  if (known) filter_.emplace(*known);
  was_observed_ = is_observed();
}

void GyroAid::add(const GyroSample& sample) {
  gyro_.add(sample);
  note_missing();
  note_clipped();
  if (gyro_.repeated_s() == 0) stuck_.clear();
  if (!gyro_.rests(sample.rate)) note_stuck(sample.time);
}

void GyroAid::note_missing() {
  // A cheap one loses a fiftieth; a share is known to a seventh by so many.
  constexpr double kNamedShare = 0.05;
  constexpr int kEnough = 50;
  if (names_missing_ || gyro_.missing() < kEnough || gyro_.missing_share() < kNamedShare) return;
  names_missing_ = true;
  reports_.push_back("gyro: " + describe_missing());
}

void GyroAid::note_clipped() {
  const ClippedRates* axis = names_clipped_ ? nullptr : gyro_.clipped();
  if (!axis) return;
  names_clipped_ = true;
  reports_.push_back(formatted("gyro: its rates end at %.3g degrees/s, the limit of its range",
                               deg(gyro_.unit() * axis->limit())));
}

std::string GyroAid::describe_missing() const {
  return formatted("%.0f %% of its samples are missing", 100 * gyro_.missing_share());
}

void GyroAid::note_stuck(Timestamp time) {
  if (!stuck_.empty() || gyro_.repeated_s() < kStuckS) return;
  stuck_ = formatted("stuck: it has repeated its rates for %.1f s at ", gyro_.repeated_s()) +
           to_string(time) + " s";
  reports_.push_back("gyro: " + stuck_);
}

void GyroAid::see(Timestamp begin, Timestamp end, const Eigen::Quaterniond& R,
                  const Eigen::Matrix3d& covariance) {
  if (!has_samples() || !covariance.allFinite() || !R.coeffs().allFinite()) return;
  const SeenTurn seen{gyro_.seconds(begin), gyro_.seconds(end), R, covariance};
  constexpr double kTurns = rad(3);  // a second
  if (rotation_vector(R).norm() > kTurns * (seen.end - seen.begin) + 3 * std::sqrt(covariance.trace()))
    note_stuck(end);
  if (filter_) follow(seen);
  if (!is_observed() || checks_change_) {
    turns_.push_back(seen);
    if (turns_.size() >= next_calibration_) calibrate();
  }
  last_ = seen;
}

void GyroAid::images_changed() {
  // What rows that are not straight have turned gyros by, and what they have added to their rates a second.
  constexpr double kOff = rad(3), kBiasOff = rad(3);
  turns_.clear();
  compared_.clear();
  last_.reset();
  next_calibration_ = kFirstTurns;
  if (!filter_) return;
  GyroModel model = filter_->model();
  model.covariance.diagonal().head<3>().array() += kOff * kOff;
  model.covariance.diagonal().segment<3>(kGyroBias).array() += kBiasOff * kBiasOff;
  filter_.emplace(model);
  was_observed_ = false;
}

// Of many turns the smallest say least; of forgotten samples none.
void GyroAid::calibrate() {
  const auto is_forgotten = [&](const SeenTurn& t) { return t.begin - kMostGyroOffsetS < gyro_.oldest(); };
  if (gyro_.forgets()) turns_.erase(std::remove_if(turns_.begin(), turns_.end(), is_forgotten), turns_.end());
  if (turns_.size() > kMostTurns) {
    std::vector<double> angles;
    for (const SeenTurn& t : turns_) angles.push_back(rotation_vector(t.R).squaredNorm());
    const double least = of_rank(std::move(angles), turns_.size() - kMostTurns);
    const auto is_small = [&](const SeenTurn& t) { return rotation_vector(t.R).squaredNorm() < least; };
    turns_.erase(std::remove_if(turns_.begin(), turns_.end(), is_small), turns_.end());
    turns_.erase(turns_.begin(), turns_.end() - std::ptrdiff_t(std::min(turns_.size(), kMostTurns)));
  }
  take_fit(fit_gyro(gyro_, turns_));
  next_calibration_ = size_t(kTurnsFactor * double(turns_.size())) + 1;
}

void GyroAid::report_once(const std::string& line, std::string* last) {
  if (line != *last) reports_.push_back("gyro: " + line);
  *last = line;
}

void GyroAid::take_fit(const GyroFit& fit) {
  using Kind = GyroFit::Kind;
  if (fit.kind == Kind::kUnknown) return;
  if (fit.kind == Kind::kOtherRates && gyro_.unit() != kDegrees &&
      std::abs(std::log(fit.times / kDegrees)) < 0.2) {
    gyro_.set_unit(kDegrees);
    reports_.push_back("gyro: its rates are in degrees a second, and are converted");
    return take_fit(fit_gyro(gyro_, turns_));
  }
  const bool is_known = checks_change_ && is_observed();
  if (is_known && fit.kind == Kind::kPerhapsMirrored) return;
  checks_change_ = false;
  if (is_known && !filter_->is_broken() &&
      fit.kind == (filter_->model().is_mirrored() ? Kind::kMirrored : Kind::kRelated))
    return;  // as it was followed
  filter_.reset();
  if (fit.kind == Kind::kPerhapsMirrored) {
    fault_ = "not used yet: its axes may be mirrored, or two swapped";
    return;
  }
  if (fit.kind == Kind::kMirrored)
    return report_once("not used: its axes are mirrored, or two are swapped (left-handed)", &fault_);
  if (fit.kind == Kind::kOtherRates) {
    char text[120];
    std::snprintf(text, sizeof text, "not used: the images turn %.2f times as fast as its rates", fit.times);
    return report_once(text, &fault_);
  }
  if (fit.kind == Kind::kOtherClock) {
    char text[120];
    std::snprintf(text, sizeof text, "not used: its clock is %.1f s %s that of the images: correct its times",
                  std::abs(fit.offset_s), fit.offset_s > 0 ? "ahead of" : "behind");
    return report_once(text, &fault_);
  }
  if (fit.kind == Kind::kUnrelated)
    return report_once("not used: the images turn, and it does not turn with them", &fault_);
  filter_.emplace(fit.model);
  fault_.clear();
  if (!is_observed() || was_observed_) return;
  was_observed_ = true;
  reports_.push_back("gyro: observed, " + describe(fit.model));
}

// Variance of the errors over that of the covariance; 1: it is right, or too large.
double GyroAid::factor() const {
  if (compared_.size() < kCompared / 2) return 1;
  std::vector<double> sigmas2;
  for (const Compared& c : compared_) sigmas2.push_back(c.sigmas2);
  return std::max(1.0, median(std::move(sigmas2)) / kMedianChiSquare);
}

// Median squared errors, by the gyro and by constant velocity.
std::pair<double, double> GyroAid::errors2() const {
  std::vector<double> by_gyro2, by_going_on2;
  for (const Compared& c : compared_) by_gyro2.push_back(c.by_gyro2), by_going_on2.push_back(c.by_going_on2);
  return {median(std::move(by_gyro2)), median(std::move(by_going_on2))};
}

void GyroAid::follow(const SeenTurn& seen) {
  const std::optional<CameraTurn> shown = camera_turn(gyro_, filter_->model(), seen.begin, seen.end);
  if (!shown) return;
  const bool was_broken = filter_->is_broken();
  if (const auto change = filter_->see(gyro_, seen, factor())) {
    note(describe(*change), change->since_s);
    const bool sits_as_before =
        change->kind == GyroChangeKind::kBias || change->kind == GyroChangeKind::kClock;
    if (!sits_as_before) check_again();
  }
  if (filter_->is_broken() && !was_broken) {
    note("set aside: it does not turn as the images do", seen.begin);
    check_again();
  }
  compare(seen, *shown, rotation_vector(seen.R * shown->R.conjugate()));
}

void GyroAid::note(const std::string& change, double since_s) {
  changed_ = change + formatted(" at %.2f s after its first sample", since_s);
  reports_.push_back("gyro: " + changed_);
}

// Whether and how it turns with the camera is found as that of a new one, from now on, and until then it is
// not used: what explains a change of two axes that were swapped fits for as long as the camera turns as now.
void GyroAid::check_again() {
  if (checks_change_) return;
  checks_change_ = true;
  turns_.clear();
  next_calibration_ = kFirstTurns;
}

void GyroAid::compare(const SeenTurn& seen, const CameraTurn& shown, const Eigen::Vector3d& beyond) {
  const bool goes_on = last_ && std::abs(last_->end - seen.begin) < 1e-6;
  if (!goes_on) return;
  const double share = (seen.end - seen.begin) / (last_->end - last_->begin);
  const Eigen::Quaterniond as_before = rotation_of(share * rotation_vector(last_->R));
  const Eigen::Matrix3d S = shown.covariance + seen.covariance;
  compared_.push_back({beyond.squaredNorm(), rotation_vector(seen.R * as_before.conjugate()).squaredNorm(),
                       beyond.dot(S.inverse() * beyond), shown.noise.trace(), seen.covariance.trace()});
  if (compared_.size() > kCompared) compared_.pop_front();
  if (compared_.size() < kCompared / 2) return;
  if (compared_.size() == kCompared && is_noisy() && !std::exchange(names_noise_, true))
    reports_.push_back("gyro: noisy: " + describe_noise());
  const auto [gyro2, going_on2] = errors2();
  // What it states itself may be as large: a cheap one next to a camera that goes straight on.
  if (gyro2 > kWorse * going_on2 && factor() > kWorse) refuse(gyro2, going_on2);
}

// It is calibrated anew: it may have been moved, or a file said something else.
void GyroAid::refuse(double gyro2, double going_on2) {
  report_once(formatted_degrees("not used: it contradicts the images, by %.2f degrees an image, and to go on "
                                "turning as before by %.2f",
                                std::sqrt(gyro2), std::sqrt(going_on2)),
              &fault_);
  filter_.reset();
  was_observed_ = checks_change_ = false;
  turns_.clear();
  compared_.clear();
  next_calibration_ = kFirstTurns;
}

std::optional<CameraTurn> GyroAid::turn(Timestamp begin, Timestamp end) const {
  if (!is_used() || filter_->was_broken_after(gyro_.seconds(begin))) return std::nullopt;
  std::optional<CameraTurn> found =
      camera_turn(gyro_, filter_->model(), gyro_.seconds(begin), gyro_.seconds(end));
  if (!found) return std::nullopt;
  const double dt = seconds_between(begin, end);
  found->covariance *= factor();
  found->broken2 = filter_->variance_of_rate() * dt * dt;
  found->covariance.diagonal().array() += found->broken2;
  return found;
}

std::optional<RateOfPoints> GyroAid::rate_of_points(Timestamp time, double readout_s) const {
  if (!is_used() || filter_->is_broken()) return std::nullopt;
  const GyroModel& model = filter_->model();
  const double camera = gyro_.seconds(time), t = camera + model.offset_at(camera);
  const auto rate = gyro_.rate(t, model.errors);
  if (!rate) return std::nullopt;
  RateOfPoints points{-(model.R_cam_gyro * *rate)};
  const auto first = gyro_.rate(t - 0.5 * readout_s, model.errors),
             last = gyro_.rate(t + 0.5 * readout_s, model.errors);
  if (readout_s != 0 && first && last) points.turning = -(model.R_cam_gyro * (*last - *first)) / readout_s;
  return points;
}

std::vector<std::string> GyroAid::take_reports() { return std::exchange(reports_, {}); }

std::string GyroAid::statement() const {
  if (!has_samples()) return {};
  if (!stuck_.empty()) return stuck_;
  if (!fault_.empty()) return fault_;
  const std::string changed =
      (changed_.empty() ? "" : "; " + changed_) + (checks_change_ ? "; not used: checked after that" : "");
  if (!filter_) return "not observed: the camera has not turned enough" + changed;
  if (!is_observed())
    return "not observed: the camera has turned about one axis only; " + describe(filter_->model()) +
           describe_samples() + changed;
  return "observed, " + describe(filter_->model()) + describe_samples() + changed;
}

// Whether a rotation of the images is surer than that of the gyro by its noise alone.
bool GyroAid::is_noisy() const {
  std::vector<double> ratios;
  for (const Compared& c : compared_) ratios.push_back(c.noise2 / c.image2);
  return !ratios.empty() && median(std::move(ratios)) > 1;
}

std::string GyroAid::describe_noise() const {
  return formatted("noise %.4f degrees/s/sqrt(Hz)", deg(gyro_.noise())) +
         (is_noisy() ? ", more than that of the images" : "");
}

std::string GyroAid::describe_samples() const {
  const std::string spikes =
      gyro_.spikes() > 0 ? ", " + std::to_string(gyro_.spikes()) + " spikes left out" : "";
  return ", " + describe_noise() + (names_missing_ ? ", " + describe_missing() : "") + spikes;
}

}  // namespace edgevo
