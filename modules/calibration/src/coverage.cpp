// SPDX-License-Identifier: BSD-3-Clause
#include "coverage.h"

#include <algorithm>
#include <cmath>
#include "edgevo/core/angle.h"

namespace edgevo {
namespace {

constexpr double kBorder =
    1.0 / 6;  // of the image's side: half the margin that a third of the views should reach
constexpr double kTilt = rad(15);  // a smaller tilt hardly changes the view (its cosine is 0.97)

struct Extent {
  float left = 1, right = 0, top = 1, bottom = 0;  // of all corners, as shares of the image's sides
};

Extent extent_of(const std::vector<ViewFit>& views, int width, int height) {
  Extent e;
  for (const ViewFit& view : views)
    for (const Eigen::Vector2f& px : view.px) {
      const float x = px.x() / float(width), y = px.y() / float(height);
      e = {std::min(e.left, x), std::max(e.right, x), std::min(e.top, y), std::max(e.bottom, y)};
    }
  return e;
}

// The largest tilt around an axis, radians: `axis` 0 is to the left or right, 1 up or down.
double largest_tilt(const std::vector<ViewFit>& views, int axis) {
  double most = 0;
  for (const ViewFit& view : views) most = std::max(most, std::asin(std::abs(view.normal_cam[axis])));
  return most;
}

}  // namespace

bool is_tilted(const std::vector<ViewFit>& views) {
  return std::max(largest_tilt(views, 0), largest_tilt(views, 1)) >= kTilt;
}

std::vector<std::string> what_is_lacking(const std::vector<ViewFit>& views, int width, int height) {
  const Extent e = extent_of(views, width, height);
  std::string sides;
  const auto unseen = [&](bool is, const char* side) {
    if (is) sides += (sides.empty() ? "" : ", ") + std::string(side);
  };
  unseen(e.left > kBorder, "left");
  unseen(e.right < 1 - kBorder, "right");
  unseen(e.top > kBorder, "top");
  unseen(e.bottom < 1 - kBorder, "bottom");
  std::vector<std::string> lacking;
  if (!sides.empty()) lacking.push_back("corners near the border (" + sides + "): the lens is a guess there");
  if (largest_tilt(views, 0) < kTilt)
    lacking.push_back("views with the board turned to the left or right by 20 degrees");
  if (largest_tilt(views, 1) < kTilt)
    lacking.push_back("views with the board tipped forward or backward by 20 degrees");
  return lacking;
}

}  // namespace edgevo
