// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/self_calibration/focal_by_corners.h"

#include <algorithm>
#include <cmath>

#include "corner_bundle.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr size_t kViews = 6;
constexpr size_t kLeastFollowed = 15;  // from view to view: where fewer are, a new window begins
constexpr double kLeastWay = 0.03;     // median way of the corners between two views, widths of the image
constexpr double kLeastTurn = 0.05;    // radians over a window: a way straight on shows no focal length
constexpr int kLeastWindows = 2, kMostWindows = 8;
// Of windows against each other, and what all may share: rows that are read out one after another, a residual
// distortion. Relative.
constexpr double kScatter = 0.05, kCommon = 0.04;

}  // namespace

struct FocalByCorners::Impl {
  Rectification rectification;
  std::vector<CornerSights> views;
  SE3 T_cam_path;
  double k1 = 0;
  int windows = 0;
  double information = 0, weighted = 0, squares = 0;  // of the logarithm of true over file's focal length

  std::vector<double> ways_since_view(const std::vector<FollowedCorner>& corners) const;
  void add_view(const std::vector<FollowedCorner>& corners);
  void measure();
};

FocalByCorners::FocalByCorners(const Rectification& rectification) : impl_(std::make_unique<Impl>()) {
  impl_->rectification = rectification;
}
FocalByCorners::~FocalByCorners() = default;
FocalByCorners::FocalByCorners(FocalByCorners&&) noexcept = default;

// Those of the corners of the last view that are still followed, widths of the image.
std::vector<double> FocalByCorners::Impl::ways_since_view(const std::vector<FollowedCorner>& corners) const {
  const double to_widths = rectification.target().fx / rectification.target().width;
  std::vector<double> ways;
  auto before = views.back().corners.begin();
  const auto end = views.back().corners.end();
  for (const FollowedCorner& c : corners) {
    while (before != end && before->id < c.id) ++before;
    if (before != end && before->id == c.id) ways.push_back(to_widths * (c.ray - before->ray).norm());
  }
  return ways;
}

void FocalByCorners::Impl::add_view(const std::vector<FollowedCorner>& corners) {
  if (!views.empty()) {
    const std::vector<double> ways = ways_since_view(corners);
    if (ways.size() < kLeastFollowed)
      views.clear();
    else if (median(ways) < kLeastWay)
      return;
  }
  views.push_back({T_cam_path, corners});
  if (views.size() < kViews) return;
  const SE3 motion = views.back().T_cam_path * views.front().T_cam_path.inverse();
  if (motion.angle() > kLeastTurn) measure();
  views.erase(views.begin(), views.begin() + kViews / 2);
}

void FocalByCorners::Impl::measure() {
  const std::optional<FocalError> found = adjust_corners(rectification, views, k1);
  if (!found) return;
  const double log_focal = std::log1p(found->value), relative = found->sigma / (1 + found->value);
  const double weight = 1 / (relative * relative + kScatter * kScatter);
  information += weight, weighted += weight * log_focal, squares += weight * log_focal * log_focal;
  ++windows;
}

void FocalByCorners::add(const std::vector<FollowedCorner>& corners, const std::optional<SE3>& T_cur_last,
                         double k1) {
  if (impl_->windows >= kMostWindows) return;
  if (!T_cur_last || k1 != impl_->k1) impl_->views.clear();
  impl_->T_cam_path = impl_->views.empty() ? SE3() : *T_cur_last * impl_->T_cam_path;
  impl_->k1 = k1;
  impl_->add_view(corners);
}

// Windows that contradict each other say so: their scatter, where it is larger than stated, is the error's.
std::optional<FocalError> FocalByCorners::error() const {
  const Impl& w = *impl_;
  if (w.windows < kLeastWindows) return std::nullopt;
  const double mean = w.weighted / w.information;
  const double scatter = (w.squares - mean * w.weighted) / (w.windows - 1);  // expected: 1
  const double sigma = std::sqrt(std::max(1.0, scatter) / w.information + kCommon * kCommon);
  return FocalError{std::expm1(mean), std::exp(mean) * sigma};
}

}  // namespace edgevo
