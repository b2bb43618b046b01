// SPDX-License-Identifier: BSD-3-Clause
// Where a lens shows directions, and how it bends straight lines.
#include <algorithm>
#include <cmath>

#include "camera_doubt.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/target_pinhole.h"
#include "edgevo/datasets/describe.h"

namespace edgevo {
namespace {

// Distance from the principal point at which a ray of this angle towards +x appears, pixels; nullopt beyond
// the range of the lens.
std::optional<double> radius_px(const Camera& camera, double angle) {
  if (angle > camera.max_angle()) return std::nullopt;
  const auto px = camera.project({std::sin(angle), 0, std::cos(angle)});
  return px ? std::optional<double>(px->x() - camera.pinhole().cx) : std::nullopt;
}

// "10: 33.6, 20: 66.9, ..." up to the corner of the image.
std::string radii_text(const Camera& camera) {
  constexpr int kStep = 10;  // degrees
  const Pinhole p = camera.pinhole();
  const double largest = std::hypot(std::max(p.cx, p.width - 1 - p.cx), std::max(p.cy, p.height - 1 - p.cy));
  std::string text;
  for (int degrees = kStep; degrees < 180; degrees += kStep) {
    const auto r = radius_px(camera, rad(degrees));
    if (!r || *r > largest) break;
    text += (text.empty() ? "" : ", ") + std::to_string(degrees) + ": " + fixed(*r, 1);
  }
  return text;
}

// How far the image of the straight line that passes through the pixel (x, y) along the axis `along` (0: x)
// has moved sideways where it leaves the image, pixels. Nullopt where the lens shows nothing.
std::optional<double> bend_px(const Camera& camera, const Eigen::Vector2d& px, int along) {
  const auto middle = camera.unproject(px);
  if (!middle) return std::nullopt;
  const Eigen::Vector3d from = middle->normalized();
  Eigen::Vector3d side = Eigen::Vector3d::Unit(along);
  side = (side - side.dot(from) * from).normalized();
  const double end = (along == 0 ? camera.width : camera.height) - 1;
  constexpr double kStep = rad(0.05);
  std::optional<double> bend;
  for (double angle = 0; angle < M_PI / 2; angle += kStep) {
    const Eigen::Vector3d ray = std::cos(angle) * from + std::sin(angle) * side;
    const auto at = camera.project(ray);
    if (!at || std::atan2(ray.head<2>().norm(), ray.z()) > camera.max_angle() || (*at)[along] > end) break;
    bend = (*at)[1 - along] - px[1 - along];
  }
  return bend;
}

// "row 24: +31.2 px, ...": lines at these shares of a side, each towards the border at the right or the
// bottom.
std::string bends_text(const Camera& camera, int along) {
  std::string text;
  for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95}) {
    Eigen::Vector2d px(camera.pinhole().cx, camera.pinhole().cy);
    px[1 - along] = share * ((along == 0 ? camera.height : camera.width) - 1);
    const auto bend = bend_px(camera, px, along);
    text += (text.empty() ? "" : ", ") + fixed(px[1 - along], 0) + ": " +
            (bend ? (*bend > 0 ? "+" : "") + fixed(*bend, 1) : "nothing");
  }
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> describe(const Camera& camera) {
  auto lines = describe_numbers(camera);
  if (camera.has_distortion()) {
    lines.emplace_back("angles to px",
                       radii_text(camera) + " (degrees from the axis: pixels from its image)");
    lines.emplace_back("rows bend by", bends_text(camera, 0) + " px (row: shift at the right border)");
    lines.emplace_back("columns bend by", bends_text(camera, 1) + " px (column: shift at the lower border)");
  }
  const InputDecision d = describe_target(camera, target_pinhole(camera));
  lines.emplace_back(d.subject, d.value + " (" + d.reason + ")");
  if (const std::string doubt = doubt_about(camera); !doubt.empty()) lines.emplace_back("WARNING", doubt);
  return lines;
}

}  // namespace edgevo
