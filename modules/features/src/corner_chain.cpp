// SPDX-License-Identifier: BSD-3-Clause
#include "corner_chain.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "edgevo/core/order_statistics.h"
#include "edgevo/core/radial.h"

namespace edgevo {
namespace {

constexpr double kDepthNoisePx = 0.8;  // of a measured depth: also anchor, pose and drift of the patch
constexpr int kMinToStart = 20, kMinToGoOn = 12, kMaxFailures = 5;
constexpr double kKnownDepth = 0.25;  // relative standard deviation
constexpr double kGuess = 1e4;        // factor on the variance of a depth that is not known
constexpr int kMaxMisses = 3;
constexpr double kMinShareToGoOn = 0.3;
// Information of a depth counts as at most so many of its best measurements: they share the anchor's error.
constexpr double kIndependent = 3;
// Widths of the robust kernel, whitened, from coarse to fine.
constexpr std::array<double, 4> kWidths{8, 4, 2, 2};
// The prior on a step, wide: it only holds what the corners do not show.
constexpr double kPriorRotation = 0.03, kPriorTranslation = 0.5, kPriorLeastDepths = 0.02;

}  // namespace

struct CornerChain::Fit {
  SE3 T_cam_path;
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double cost = 0;
  double noise = 1;  // of the whitened residuals, at least 1
  int agreeing = 0, seen = 0;
};

// A depth that is only guessed has no say: many guesses would make a unit.
CornerSight CornerChain::predict(const Corner& c, const SE3& T_cam_path) const {
  const double variance = (is_known(c) ? 1 : kGuess) / c.information;
  return predict_corner({c.ray, c.idepth, variance, c.px}, T_cam_path * c.T_anchor_path.inverse(), pinhole_);
}

CornerChain::Fit CornerChain::linearise(const SE3& T_cam_path, double width) const {
  Fit f;
  f.T_cam_path = T_cam_path;
  std::vector<double> errors;
  for (const Corner& c : corners_) {
    const CornerSight s = predict(c, T_cam_path);
    ++f.seen;
    const double c2 = width * width;
    if (!s.is_visible) {
      f.cost += c2;
      continue;
    }
    const Eigen::Vector2d e = c.px - s.px;
    const double r2 = e.dot(s.weight * e);
    const double w = 1 / ((1 + r2 / c2) * (1 + r2 / c2));
    f.cost += r2 / (1 + r2 / c2);
    const Eigen::Matrix<double, 6, 2> JW = w * s.J.transpose() * s.weight;
    f.H.noalias() += JW * s.J;
    f.b.noalias() += JW * e;
    f.agreeing += r2 < kMaxCornerError * kMaxCornerError;
    errors.push_back(r2);
  }
  // Of a squared residual of two directions the median is 1.39.
  if (!errors.empty()) f.noise = std::sqrt(std::max(1.0, median(std::move(errors)) / 1.39));
  return f;
}

CornerChain::Fit CornerChain::fit(SE3 T, const SE3& expected) const {
  const double least = kPriorLeastDepths / std::max(median_idepth(), 1e-9);
  const SE3 step = expected * T_cam_path_.inverse();
  const double sigma_t = kPriorTranslation * std::max(step.translation().norm(), least);
  Matrix6d prior = Matrix6d::Zero();
  prior.diagonal() << Eigen::Vector3d::Constant(1 / (sigma_t * sigma_t)),
      Eigen::Vector3d::Constant(1 / (kPriorRotation * kPriorRotation));
  for (const double width : kWidths) {
    const Fit f = linearise(T, width);
    const Vector6d away = (expected * T.inverse()).log();
    const Matrix6d H = f.H + prior;
    const Vector6d xi = H.ldlt().solve(f.b + prior * away);
    if (!xi.allFinite()) break;
    T = SE3::exp(xi) * T;
  }
  return linearise(T, kWidths.back());
}

// The start with the lower cost after the coarsest look decides; corners alone evaluation.
std::optional<CornerChain::Fit> CornerChain::best_fit(const std::vector<SE3>& starts) {
  std::optional<Fit> best;
  const SE3* from = nullptr;
  double least = 0;
  for (const SE3& start : starts) {
    if (!start.is_finite()) continue;
    const double cost = linearise(start, kWidths.front()).cost;
    if (!from || cost < least) from = &start, least = cost;
  }
  if (!from) return best;
  const Fit f = fit(*from, *from);
  if (f.T_cam_path.is_finite() && f.agreeing >= kMinToGoOn && f.agreeing >= kMinShareToGoOn * f.seen)
    best = f;
  return best;
}

// Keeps the corners that are still followed, with their new pixels.
void CornerChain::match(const std::vector<CornerTrack>& tracks) {
  std::vector<Corner> kept;
  size_t t = 0;
  for (Corner& c : corners_) {
    while (t < tracks.size() && tracks[t].id < c.id) ++t;
    if (t == tracks.size() || tracks[t].id != c.id) continue;
    c.px = tracks[t].px.cast<double>();
    kept.push_back(c);
  }
  corners_ = std::move(kept);
}

void CornerChain::drop_outliers(double noise) {
  std::vector<Corner> kept;
  for (Corner& c : corners_) {
    const CornerSight s = predict(c, T_cam_path_);
    c.error = 1e9;
    if (s.is_visible) c.error = std::sqrt((c.px - s.px).dot(s.weight * (c.px - s.px)));
    c.misses = c.error > kMaxCornerError * noise ? c.misses + 1 : 0;
    if (c.misses < kMaxMisses)
      kept.push_back(c);
    else
      rejected_.push_back(c.id);
  }
  corners_ = std::move(kept);
}

void CornerChain::update_depths() {
  for (Corner& c : corners_) {
    const CornerSight s = predict(c, T_cam_path_);
    if (!s.is_visible || c.misses > 0) continue;
    const double here = s.slope.squaredNorm() / (kDepthNoisePx * kDepthNoisePx);
    if (!(here > 0)) continue;
    const double off = s.slope.dot(c.px - s.px) / s.slope.squaredNorm();
    c.best = std::max(c.best, here);
    const double sum = c.information + here;
    c.idepth = std::max(0.0, c.idepth + here / sum * off);
    c.information = std::min(sum, std::max(c.information, kIndependent * c.best));
  }
}

// Inverse depth of the known corner that is nearest in the newest image; `fallback` if there is none.
double CornerChain::idepth_around(const Eigen::Vector2d& px, double fallback) const {
  double least = std::numeric_limits<double>::infinity(), idepth = fallback;
  for (const Corner& c : corners_) {
    if (!is_known(c) || c.misses > 0) continue;
    const double square = (c.px - px).squaredNorm();
    if (square >= least) continue;
    const SE3 T = T_cam_path_ * c.T_anchor_path.inverse();
    const double z = (T.rotation() * c.ray + c.idepth * T.translation()).z();
    if (z > 0) least = square, idepth = c.idepth / z;
  }
  return idepth;
}

void CornerChain::add_corners(const std::vector<CornerTrack>& tracks) {
  std::vector<Corner> fresh;
  const double usual = median_idepth();
  for (const CornerTrack& t : tracks) {
    if (!corners_.empty() && t.id <= corners_.back().id) continue;
    if (std::find(rejected_.begin(), rejected_.end(), t.id) != rejected_.end()) continue;
    Corner c;
    c.id = t.id;
    c.px = t.px.cast<double>();
    c.ray = pinhole_.ray(c.px);
    c.T_anchor_path = T_cam_path_;
    c.idepth = idepth_around(c.px, usual);
    c.information = 1 / (4 * usual * usual);
    fresh.push_back(c);
  }
  corners_.insert(corners_.end(), fresh.begin(), fresh.end());
}

bool CornerChain::is_known(const Corner& c) {
  return c.information * c.idepth * c.idepth * kKnownDepth * kKnownDepth > 1;
}

int CornerChain::known_depths() const {
  return int(std::count_if(corners_.begin(), corners_.end(), is_known));
}

double CornerChain::median_idepth() const {
  std::vector<double> idepths;
  for (const Corner& c : corners_)
    if (is_known(c)) idepths.push_back(c.idepth);
  return idepths.empty() ? first_idepth_ : median(std::move(idepths));
}

void CornerChain::change_lens(const ImageCorrection& lens) {
  if (lens.has_lens_of(lens_)) return;
  for (Corner& c : corners_) c.ray.head<2>() = remove_lens(lens, add_lens(lens_, c.ray.head<2>()));
  lens_ = lens;
}

std::vector<ExpectedCorner> CornerChain::expect(const std::optional<SE3>& T_cur_last) const {
  SE3 step = velocity_;
  if (T_cur_last) step = is_running_ ? SE3(T_cur_last->rotation(), velocity_.translation()) : *T_cur_last;
  std::vector<ExpectedCorner> expected;
  for (const Corner& c : corners_) {
    const SE3 T = step * T_cam_path_ * c.T_anchor_path.inverse();
    const Eigen::Vector3d X = T.rotation() * c.ray + c.idepth * T.translation();
    if (!(X.z() > kLeastCornerDepth)) continue;
    const Eigen::Vector2d px = pinhole_.project(X);
    if (pinhole_.contains(px)) expected.push_back({c.id, px.cast<float>()});
  }
  return expected;
}

ChainStep CornerChain::step_of(const std::optional<Fit>& found) const {
  ChainStep step;
  step.T_cam_path = T_cam_path_;
  if (!found || !is_running_) return step;
  step.is_measured = true;
  step.agreeing = found->agreeing;
  Matrix6d H = found->H;
  H.diagonal().array() += 1e-12;
  step.covariance = found->noise * found->noise * H.ldlt().solve(Matrix6d::Identity());
  return step;
}

ChainStep CornerChain::add(const CornerView& view, const std::optional<SE3>& T_cur_last) {
  pinhole_ = view.pinhole;
  match(view.tracks);
  std::vector<SE3> starts;
  if (T_cur_last) starts.push_back(*T_cur_last);
  if (is_running_ || starts.empty()) starts.push_back(velocity_);
  for (SE3& start : starts) start = start * T_cam_path_;

  // Also before depths are known: then corners show rotation and direction, and the odometry the length.
  std::optional<Fit> found;
  if (int(corners_.size()) >= kMinToGoOn) found = best_fit(starts);
  const SE3 last = T_cam_path_;
  T_cam_path_ = found ? found->T_cam_path : starts.front();
  velocity_ = T_cam_path_ * last.inverse();
  if (found) {
    failures_ = 0;
    drop_outliers(found->noise);
  } else if (++failures_ >= kMaxFailures || (!is_running_ && !T_cur_last)) {
    // Nobody knows the motion: what the corners were goes with it.
    is_running_ = false;
    failures_ = 0;
    corners_.clear();
  }
  ChainStep step = step_of(found);
  if (found || T_cur_last) {
    update_depths();
    add_corners(view.tracks);
  }
  if (known_depths() >= kMinToStart) is_running_ = true;
  if (known_depths() > 0) step.median_depth = 1 / median_idepth();
  return step;
}

}  // namespace edgevo
