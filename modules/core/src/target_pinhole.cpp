// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/target_pinhole.h"

#include <algorithm>
#include <cmath>

#include "camera_models/lens_math.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// Interpolation between pixels at the rate of the lens blurs the finest detail. A quarter more pixels to a
// side keep it: the rendered corridor through lenses of 190 degrees has 0.6 to 0.3 times the error
// (lab 2026-11-26_lenses). Not beyond as many pixels as images have that are not scaled
// down for the sake of time (--image-scale auto).
constexpr double kFiner = 1.25, kMaxPixels = 720000;

// Largest angle from the axis at which the camera shows the rays towards `direction` within its image.
double angle_towards(const Camera& camera, const Eigen::Vector2d& direction) {
  const auto is_seen = [&](double angle) {
    const Eigen::Vector2d side = direction * std::sin(angle);
    const auto px = camera.project({side.x(), side.y(), std::cos(angle)});
    return px && px->x() >= -0.5 && px->y() >= -0.5 && px->x() <= camera.width - 0.5 &&
           px->y() <= camera.height - 0.5;
  };
  return last_that_holds(0, camera.max_angle(), is_seen);
}

// A range of normalised coordinates along one axis of the image.
struct Range {
  double before, after;  // tangents of the angles to both sides

  double length() const { return before + after; }
  int size(double focal) const { return std::max(1, int(std::lround(focal * length()))); }
  // Principal point of an image of `pixels`, which shows the same share of both sides.
  double centre(int pixels) const { return pixels * before / std::max(length(), 1e-9) - 0.5; }
};

Range range_of(double before, double after, double largest) {
  return {std::tan(std::min(before, largest)), std::tan(std::min(after, largest))};
}

// Focal length of the target over that of the lens.
double finer_scale(const Pinhole& raw, const Range& x, const Range& y) {
  const double pixels = double(x.size(raw.fx)) * y.size(raw.fy);
  return std::clamp(std::sqrt(kMaxPixels / pixels), 1.0, kFiner);
}

std::string degrees_text(double horizontal, double vertical) {
  return fixed(deg(horizontal), 0) + " x " + fixed(deg(vertical), 0) + " degrees";
}

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

}  // namespace

ViewAngles view_angles(const Camera& camera) {
  return {angle_towards(camera, {-1, 0}), angle_towards(camera, {1, 0}), angle_towards(camera, {0, -1}),
          angle_towards(camera, {0, 1})};
}

Pinhole target_pinhole(const Camera& camera, const TargetRequest& request) {
  const Pinhole raw = camera.pinhole();
  if (request.is_empty() && camera.plumb_bob()) return raw;
  const ViewAngles view = view_angles(camera);
  const double largest = rad(request.view_deg.value_or(kWidestView) / 2);
  const Range x = range_of(view.left, view.right, largest), y = range_of(view.up, view.down, largest);
  Pinhole target = raw;
  if (request.width > 0) {
    const double scale =
        std::max(request.width / (raw.fx * x.length()), request.height / (raw.fy * y.length()));
    target.fx *= scale, target.fy *= scale;
    target.width = request.width, target.height = request.height;
  } else {
    const double scale = camera.plumb_bob() ? 1 : finer_scale(raw, x, y);
    target.fx *= scale, target.fy *= scale;
    target.width = x.size(target.fx), target.height = y.size(target.fy);
  }
  target.cx = x.centre(target.width), target.cy = y.centre(target.height);
  return target;
}

double cropped_share(const Camera& camera, const Pinhole& target) {
  constexpr int kGrid = 64;  // samples a side: per cents need no more
  const double max_angle = camera.max_angle();
  int seen = 0, shown = 0;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const auto ray =
          camera.unproject({(i + 0.5) / kGrid * camera.width - 0.5, (j + 0.5) / kGrid * camera.height - 0.5});
      if (!ray || std::atan2(ray->head<2>().norm(), ray->z()) > max_angle) continue;
      ++seen;
      shown += ray->z() > 0 && target.contains(target.project(*ray), -0.5);
    }
  return seen > 0 ? 1 - double(shown) / seen : 0;
}

InputDecision describe_target(const Camera& camera, const Pinhole& target) {
  const ViewAngles raw = view_angles(camera), seen = view_angles(Camera(target));
  const double share = cropped_share(camera, target);
  InputDecision d;
  d.subject = "rectified";
  d.value = "to a pinhole of " + size_text(target.width, target.height) + " and " +
            degrees_text(seen.horizontal(), seen.vertical()) + ", focal length " + fixed(target.fx, 1) +
            " px";
  d.reason = std::string(to_string(camera.model)) + " lens of " +
             degrees_text(raw.horizontal(), raw.vertical()) + ", " + fixed(camera.pinhole().fx, 1) + " px; " +
             (share < 0.005 ? "nothing" : fixed(100 * share, 0) + " % of the image") + " is cut off";
  return d;
}

}  // namespace edgevo
