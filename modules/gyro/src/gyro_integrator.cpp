// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/gyro/gyro_integrator.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/order_statistics.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo {
namespace {

// Kept: a keyframe is rarely older than that.
constexpr double kKeptS = 60;
// Samples that noise and step are measured from, and after how many new ones that is done again.
constexpr int kMeasured = 400, kMeasureEvery = 40;
// Rates of a gyro at rest, rad/s: its bias, and what it rounds to nothing.
constexpr double kRest = 0.02;
// Three samples that are further apart than so many steps lack one.
constexpr double kStepsApart = 2.5;
// Median of the square of a normal variable of unit variance.
constexpr double kMedianSquare = 0.4549;

template <class S>
Eigen::Vector3d between(const S& a, const S& b, double t) {
  const double share = b.t > a.t ? (t - a.t) / (b.t - a.t) : 0;
  return a.rate + share * (b.rate - a.rate);
}

}  // namespace

void ClippedRates::add(double rate) {
  constexpr double kBelow = 0.9;  // a turn is as long at its largest rate, within rounding, as between
  const double magnitude = std::abs(rate);
  ++rates_;
  if (magnitude > limit_) {
    below_ = limit_ >= kBelow * magnitude ? below_ + at_limit_ : 0;
    limit_ = magnitude, at_limit_ = 1;
  } else if (magnitude == limit_) {
    ++at_limit_;
  } else if (magnitude >= kBelow * limit_) {
    ++below_;
  }
}

bool ClippedRates::is_clipped() const {
  // Without rates just below, the sensor rounds coarsely. A tenth of a second of a slow one is chance.
  constexpr int kEnough = 20;
  return below_ > 0 && at_limit_ >= kEnough && at_limit_ > 2 * below_;
}

const ClippedRates* GyroIntegrator::clipped() const {
  const auto axis = std::find_if(axes_.begin(), axes_.end(), [](const auto& a) { return a.is_clipped(); });
  return axis == axes_.end() ? nullptr : &*axis;
}

bool GyroIntegrator::add(const GyroSample& sample) {
  if (!first_) first_ = sample.time;
  const double t = seconds(sample.time);
  if (!sample.rate.allFinite() || (!samples_.empty() && t <= samples_.back().t)) return false;
  count_missing(t);
  const bool repeats = !samples_.empty() && unit_ * sample.rate == samples_.back().rate;
  if (!repeats) repeated_since_ = t;
  repeated_s_ = t - repeated_since_;
  if (repeats && !rests(sample.rate)) return false;
  for (int i = 0; i < 3; ++i) axes_[size_t(i)].add(sample.rate[i]);
  weigh_newest(t, unit_ * sample.rate);
  Sample next{t, unit_ * sample.rate, Eigen::Vector3d::Zero()};
  if (!samples_.empty()) {
    const Sample& last = samples_.back();
    next.integral = last.integral + 0.5 * (t - last.t) * (last.rate + next.rate);
    if (t - last.t > kMaxGapS) gaps_.push_back(t);
  }
  samples_.push_back(next);
  forget();
  if (++since_measured_ >= kMeasureEvery) measure_noise(), since_measured_ = 0;
  return true;
}

// A sample that repeats its rates is not missing, though it is not used.
void GyroIntegrator::count_missing(double t) {
  if (step_ > 0 && t > offered_until_)
    missing_ += std::max(0, int(std::lround((t - offered_until_) / step_)) - 1);
  offered_until_ = std::max(offered_until_, t);
  ++offered_;
}

// By its neighbours, of which `rate` is the next one.
void GyroIntegrator::weigh_newest(double t, const Eigen::Vector3d& rate) {
  constexpr double kSigmas = 6;  // motion bends rates by as much as their noise
  if (samples_.size() < 2 || noise_ == 0) return;
  const Sample& a = samples_[samples_.size() - 2];
  Sample& b = samples_.back();
  if (t - a.t > kStepsApart * step_) return;  // one is missing
  const double share = (b.t - a.t) / (t - a.t), sample2 = noise_ * noise_ / step_;
  const double off2 = (b.rate - a.rate - share * (rate - a.rate)).squaredNorm();
  const double by_noise = kSigmas * kSigmas * 1.5 * sample2, apart2 = (rate - a.rate).squaredNorm();
  if (off2 > by_noise + apart2) {
    samples_.pop_back();
    samples_.back().unsure2 = 0;  // it was compared with the spike
    ++spikes_;
  } else if (off2 > by_noise) {
    b.unsure2 = off2;
  }
}

bool GyroIntegrator::rests(const Eigen::Vector3d& rate) const { return unit_ * rate.norm() < kRest; }

void GyroIntegrator::set_unit(double rad_per_unit) {
  const double factor = rad_per_unit / unit_;
  for (Sample& s : samples_) s.rate *= factor, s.integral *= factor, s.unsure2 *= factor * factor;
  noise_ *= factor;
  unit_ = rad_per_unit;
}

void GyroIntegrator::forget() {
  while (samples_.back().t - samples_.front().t > kKeptS) samples_.pop_front();
  while (!gaps_.empty() && gaps_.front() <= samples_.front().t) gaps_.pop_front();
}

// Of three samples a step apart, m1 - 2 m2 + m3 has six times the variance of one.
void GyroIntegrator::measure_noise() {
  const size_t n = std::min(samples_.size(), size_t(kMeasured)), first = samples_.size() - n;
  std::vector<double> steps, squares;
  for (size_t i = first + 1; i < samples_.size(); ++i) steps.push_back(samples_[i].t - samples_[i - 1].t);
  step_ = median(std::move(steps));
  for (size_t i = first + 2; i < samples_.size(); ++i) {
    const Sample &a = samples_[i - 2], &b = samples_[i - 1], &c = samples_[i];
    if (c.t - a.t > kStepsApart * step_) continue;  // one is missing
    const Eigen::Vector3d off = a.rate - 2 * b.rate + c.rate;
    for (int k = 0; k < 3; ++k) squares.push_back(off[k] * off[k] / 6);
  }
  noise_ = std::sqrt(median(std::move(squares)) / kMedianSquare * step_);
}

std::optional<GyroIntegrator::Iterator> GyroIntegrator::first_within(double begin, double end) const {
  if (samples_.size() < 2 || begin < samples_.front().t || end > samples_.back().t || end < begin)
    return std::nullopt;
  const auto gap = std::upper_bound(gaps_.begin(), gaps_.end(), begin);
  const auto after = [](double t, const Sample& s) { return t < s.t; };
  if (gap != gaps_.end()) {  // `begin` and `end` may both lie before it
    const auto until = std::lower_bound(samples_.begin(), samples_.end(), *gap,
                                        [](const Sample& s, double t) { return s.t < t; });
    if (end > (until - 1)->t) return std::nullopt;
  }
  return std::upper_bound(samples_.begin(), samples_.end(), begin, after);
}

std::optional<GyroRotation> GyroIntegrator::rotation(double begin, double end,
                                                     const GyroErrors& errors) const {
  const std::optional<Iterator> first = first_within(begin, end);
  if (!first) return std::nullopt;
  const Eigen::Vector3d factor = Eigen::Vector3d::Ones() + errors.scale;
  GyroRotation all;
  Iterator next = std::min(*first, samples_.end() - 1);
  double t = begin;
  Eigen::Vector3d shown = between(*(next - 1), *next, begin);
  all.rate_begin = factor.cwiseProduct(shown - errors.bias);
  do {
    const double until = std::min(end, next->t), dt = until - t;
    const Eigen::Vector3d at_end = between(*(next - 1), *next, until);
    const Eigen::Vector3d unbiased = 0.5 * (shown + at_end) - errors.bias;
    const Eigen::Quaterniond turn = rotation_of(-dt * factor.cwiseProduct(unbiased));
    const Eigen::Matrix3d E = turn.toRotationMatrix();
    all.R = turn * all.R;
    all.covariance = (E * all.covariance * E.transpose()).eval();
    // A sample that is missing between these leaves its part to its neighbours: their noise counts as often.
    const double missing = step_ > 0 ? std::max(1.0, (next->t - (next - 1)->t) / step_) : 1.0;
    const double unsure2 = std::max(next->unsure2, (next - 1)->unsure2);
    all.covariance.diagonal().array() += noise_ * noise_ * dt * missing * missing + unsure2 * dt * dt;
    all.by_bias = (E * all.by_bias).eval();
    all.by_bias.diagonal() += dt * factor;
    all.by_scale = (E * all.by_scale).eval();
    all.by_scale.diagonal() -= dt * unbiased;
    t = until;
    shown = at_end;
    ++next;
  } while (t < end);
  all.R.normalize();
  all.rate_end = factor.cwiseProduct(shown - errors.bias);
  return all;
}

Eigen::Vector3d GyroIntegrator::integral_to(double t) const {
  const auto after = [](double time, const Sample& s) { return time < s.t; };
  const Iterator next =
      std::min(std::upper_bound(samples_.begin(), samples_.end(), t, after), samples_.end() - 1);
  const Sample& last = *(next - 1);
  return last.integral + 0.5 * (t - last.t) * (last.rate + between(last, *next, t));
}

std::optional<Eigen::Vector3d> GyroIntegrator::mean_rate(double begin, double end) const {
  if (!(end > begin) || !first_within(begin, end)) return std::nullopt;
  return Eigen::Vector3d((integral_to(end) - integral_to(begin)) / (end - begin));
}

std::optional<Eigen::Vector3d> GyroIntegrator::rate(double t, const GyroErrors& errors) const {
  const std::optional<Iterator> first = first_within(t, t);
  if (!first) return std::nullopt;
  const Iterator next = std::min(*first, samples_.end() - 1);
  return Eigen::Vector3d(
      (Eigen::Vector3d::Ones() + errors.scale).cwiseProduct(between(*(next - 1), *next, t) - errors.bias));
}

}  // namespace edgevo
