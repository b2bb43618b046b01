// SPDX-License-Identifier: BSD-3-Clause
#include "motion_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include "edgevo/core/angle.h"

namespace edgevo {
namespace {

constexpr int kNow = 10, kBefore = 50;  // frames
constexpr int kMinFrames = 5;           // frames of a window that were measured, at least, and
constexpr double kMinMeasured = 0.7;    // share of them
// The unit of the corners drifts from image to image by this over the number of corners that agree.
constexpr double kDriftOfUnit = 0.4;

double translation_sigma(const ChainStep& step) {
  return std::sqrt(std::max(0.0, step.covariance.topLeftCorner<3, 3>().trace()));
}

}  // namespace

void MotionComparison::add(const Entry& entry) {
  entries_.push_back(entry);
  if (entries_.size() > 2 * kBefore + 1) entries_.pop_front();
}

void MotionComparison::forget_odometry() {
  for (Entry& e : entries_) e.T_cam_tracked.reset(), e.T_cam_reported.reset();
}

// Extent: root of the summed squared distances of the camera centres from their mean. First and last count.
std::optional<MotionComparison::Ratio> MotionComparison::ratio(int first, int last, OdometryPose pose) const {
  first = std::max(first, 0);
  Eigen::Vector3d sum_c = Eigen::Vector3d::Zero(), sum_o = sum_c;
  double squares_c = 0, squares_o = 0, variance = 0;
  int n = 0;
  for (int i = first; i <= last; ++i) {
    const Entry& e = entries_[size_t(i)];
    if (!e.step.is_measured || !(e.*pose)) continue;
    const Eigen::Vector3d c = e.step.T_cam_path.inverse().translation(),
                          o = (e.*pose)->inverse().translation();
    sum_c += c, sum_o += o, squares_c += c.squaredNorm(), squares_o += o.squaredNorm();
    const double sigma = translation_sigma(e.step);
    variance += sigma * sigma;
    ++n;
  }
  if (n < kMinFrames || n < kMinMeasured * (last - first + 1)) return std::nullopt;
  const double extent_c = squares_c / n - (sum_c / n).squaredNorm(),
               extent_o = squares_o / n - (sum_o / n).squaredNorm();
  variance /= n;
  if (!(extent_o > 0) || !std::isfinite(variance)) return std::nullopt;
  Ratio r;
  r.log = 0.5 * std::log(std::max(extent_c, 1e-300) / extent_o);
  r.sigma = std::sqrt(variance / std::max(extent_c, 1e-300));
  return r;
}

// Standard deviation of the drift of the corners' unit from one window's middle to the other's.
double MotionComparison::drift(int first, int last) const {
  double variance = 0;
  for (int i = std::max(first, 0); i <= last; ++i) {
    const double one = kDriftOfUnit / std::max(1, entries_[size_t(i)].step.agreeing);
    variance += one * one;
  }
  return std::sqrt(variance);
}

std::optional<double> MotionComparison::unit() const {
  const int last = int(entries_.size()) - 1;
  for (const int frames : {kNow, 3 * kNow}) {
    const std::optional<Ratio> r = ratio(last - frames, last, &Entry::T_cam_tracked);
    if (r && r->sigma < 0.3) return std::exp(r->log);
  }
  return std::nullopt;
}

void MotionComparison::compare(CornerEvidence* evidence) const {
  const int last = int(entries_.size()) - 1;
  if (last < kNow) return;
  compare_rotation(evidence);
  const std::optional<Ratio> now = ratio(last - kNow, last),
                             before = ratio(last - kNow - kBefore, last - kNow);
  if (now) evidence->scale = now->log, evidence->scale_sigma = now->sigma;
  if (before) compare_motion(*before, evidence);
  if (now && before) {
    evidence->change_10 = now->log - before->log;
    const double drifted = drift(last - (kNow + kBefore) / 2, last);
    evidence->change_10_sigma =
        std::sqrt(now->sigma * now->sigma + before->sigma * before->sigma + drifted * drifted);
  }
  if (last < kBefore + kNow) return;
  const std::optional<Ratio> late = ratio(last - kBefore, last), early = ratio(0, last - kBefore);
  if (late && early) {
    evidence->change_50 = late->log - early->log;
    const double drifted = drift(last - 3 * kBefore / 2, last - kBefore / 2);
    evidence->change_50_sigma =
        std::sqrt(late->sigma * late->sigma + early->sigma * early->sigma + drifted * drifted);
  }
}

bool MotionComparison::is_measured(const Entry& from, const Entry& to) const {
  return from.T_cam_reported && to.T_cam_reported && from.step.is_measured && to.step.is_measured;
}

void MotionComparison::compare_motion(const Ratio& before, CornerEvidence* evidence) const {
  const Entry& from = entries_[entries_.size() - 1 - kNow];
  const Entry& to = entries_.back();
  if (!is_measured(from, to)) return;
  const SE3 c = to.step.T_cam_path * from.step.T_cam_path.inverse(),
            o = *to.T_cam_reported * from.T_cam_reported->inverse();
  const Eigen::Vector3d t_c = c.translation(), t_o = std::exp(before.log) * o.translation();
  if (to.step.median_depth > 0) evidence->motion_error_depths = (t_c - t_o).norm() / to.step.median_depth;
  const double length = t_o.norm();
  if (!(length > 0)) return;
  const int last = int(entries_.size()) - 1;
  const double of_unit = t_c.norm() * std::hypot(before.sigma, drift(last - (kNow + kBefore) / 2, last));
  evidence->motion_error = (t_c - t_o).norm() / length;
  evidence->motion_sigma =
      std::hypot(translation_sigma(from.step), std::hypot(translation_sigma(to.step), of_unit)) / length;
}

void MotionComparison::compare_rotation(CornerEvidence* evidence) const {
  const Entry& from = entries_[entries_.size() - 1 - kNow];
  const Entry& to = entries_.back();
  if (!is_measured(from, to)) return;
  const SE3 c = to.step.T_cam_path * from.step.T_cam_path.inverse(),
            o = *to.T_cam_reported * from.T_cam_reported->inverse();
  const auto rotation_variance = [](const ChainStep& s) {
    return s.covariance.bottomRightCorner<3, 3>().trace();
  };
  evidence->rotation_deg = deg(c.rotation().angularDistance(o.rotation()));
  evidence->rotation_sigma_deg = deg(std::sqrt(rotation_variance(from.step) + rotation_variance(to.step)));
  const double length = c.translation().norm();
  if (!(length > 0) || !(o.translation().norm() > 0)) return;
  const double cosine = c.translation().dot(o.translation()) / (length * o.translation().norm());
  evidence->direction_deg = deg(std::acos(std::clamp(cosine, -1.0, 1.0)));
  evidence->direction_sigma_deg =
      std::min(180.0, deg(std::hypot(translation_sigma(from.step), translation_sigma(to.step))) / length);
}

}  // namespace edgevo
