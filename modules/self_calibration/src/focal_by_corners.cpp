// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/self_calibration/focal_by_corners.h"

#include <algorithm>
#include <cmath>

#include "corner_bundle.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/radial.h"

namespace edgevo {
namespace {

constexpr size_t kViews = 6;
constexpr double kMinWay = 0.03;   // median way of the corners between two views, widths of the image
constexpr double kMinTurn = 0.05;  // radians over a window: a way straight on shows no focal length
constexpr size_t kMinWindows = 3, kMaxWindows = 9;  // odd: for the median
// What all windows may share: rows that are read out one after another, a residual distortion. Relative.
constexpr double kCommon = 0.04;

std::vector<FollowedCorner> by_file(std::vector<FollowedCorner> corners, const ImageCorrection& lens) {
  for (FollowedCorner& c : corners) c.ray.head<2>() = add_lens(lens, c.ray.head<2>());
  return corners;
}
// A scatter of few windows is itself uncertain: 95 % quantile of Student's distribution over that of the
// normal one, to one per cent from three windows on.
double student(size_t windows) { return 1 + 1.2 / double(windows - 2); }

}  // namespace

struct FocalByCorners::Impl {
  Rectification rectification;
  std::vector<FeatureObservations> views;
  SE3 T_cam_path;
  ImageCorrection lens;  // of the last image
  // Logarithm of true over file's focal length by window, and the standard deviations that these state.
  std::vector<double> windows, stated_sigmas;

  std::vector<double> displacements_since_view(const std::vector<FollowedCorner>& corners) const;
  void add_view(const std::vector<FollowedCorner>& corners);
  void measure();
};

FocalByCorners::FocalByCorners(const Rectification& rectification) : impl_(std::make_unique<Impl>()) {
  impl_->rectification = rectification;
}
FocalByCorners::~FocalByCorners() = default;
FocalByCorners::FocalByCorners(FocalByCorners&&) noexcept = default;

// Those of the corners of the last view that are still followed, widths of the image.
std::vector<double> FocalByCorners::Impl::displacements_since_view(
    const std::vector<FollowedCorner>& corners) const {
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
    const std::vector<double> ways = displacements_since_view(corners);
    if (ways.empty())
      views.clear();
    else if (median(ways) < kMinWay)
      return;
  }
  views.push_back({T_cam_path, corners});
  if (views.size() < kViews) return;
  const SE3 motion = views.back().T_cam_path * views.front().T_cam_path.inverse();
  if (motion.angle() > kMinTurn) measure();
  views.erase(views.begin(), views.begin() + kViews / 2);
}

void FocalByCorners::Impl::measure() {
  const std::optional<FocalError> found = adjust_corners(rectification, views, lens);
  if (!found) return;
  windows.push_back(std::log1p(found->value));
  stated_sigmas.push_back(found->sigma / (1 + found->value));
}

void FocalByCorners::add(const std::vector<FollowedCorner>& corners, const std::optional<SE3>& T_cur_last,
                         const ImageCorrection& lens) {
  if (impl_->windows.size() >= kMaxWindows) return;
  if (!T_cur_last) impl_->views.clear();
  impl_->T_cam_path = impl_->views.empty() ? SE3() : *T_cur_last * impl_->T_cam_path;
  impl_->lens = lens;
  impl_->add_view(by_file(corners, lens));
}

// One window of five is off by far more than it states: hence the median, and the windows' own scatter, which
// is not less than what they state.
std::optional<FocalError> FocalByCorners::error() const {
  constexpr double kSigmaOverMad = 1.48, kSigmaOfMedian = 1.25;  // of a normal distribution; over the mean's
  const std::vector<double>& windows = impl_->windows;
  if (windows.size() < kMinWindows) return std::nullopt;
  const double middle = median(windows);
  std::vector<double> deviations;
  for (const double w : windows) deviations.push_back(std::abs(w - middle));
  const double scatter =
      std::max(median(impl_->stated_sigmas), student(windows.size()) * kSigmaOverMad * median(deviations));
  const double sigma = std::hypot(kSigmaOfMedian * scatter / std::sqrt(double(windows.size())), kCommon);
  return FocalError{std::expm1(middle), std::exp(middle) * sigma, int(windows.size())};
}

}  // namespace edgevo
