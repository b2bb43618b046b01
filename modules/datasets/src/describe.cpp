// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/describe.h"

#include <algorithm>
#include <cmath>

#include "assumed_camera.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/time_order.h"

namespace edgevo {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

constexpr double kDegrees = 180.0 / M_PI;  // of a radian

// Six significant digits, as calibrations are read by people.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return text;
}

std::string describe_distortion(const Distortion& d) {
  if (d.is_zero()) return "none";
  return "k1 " + number(d.k1) + ", k2 " + number(d.k2) + ", p1 " + number(d.p1) + ", p2 " + number(d.p2) +
         ", k3 " + number(d.k3) + " (plumb-bob)";
}

// Angle between the optical axis and a pixel, radians.
double angle_to_axis(const Camera& camera, const Eigen::Vector2d& px) {
  const Eigen::Vector3d ray = camera.unproject(px).value_or(camera.pinhole().ray(px));
  return std::atan2(ray.head<2>().norm(), ray.z());
}

void describe_camera(const ImageSource& source, Lines* lines) {
  const Camera camera = source.camera();
  const Pinhole p = camera.pinhole();
  lines->emplace_back("image size", std::to_string(p.width) + " x " + std::to_string(p.height));
  if (!knows_camera(source)) return;
  lines->emplace_back("camera", "fx " + number(p.fx) + ", fy " + number(p.fy) + ", cx " + number(p.cx) +
                                    ", cy " + number(p.cy) + " px");
  lines->emplace_back("distortion", describe_distortion(camera.distortion()));
  const auto [horizontal, vertical] = field_of_view_deg(camera);
  lines->emplace_back("field of view", fixed(horizontal, 1) + " x " + fixed(vertical, 1) + " deg");
}

void describe_gaps(const std::vector<Timestamp>& times, double median, Lines* lines) {
  constexpr double kGap = 2.5;  // median steps: a single missing frame is not a gap
  int gaps = 0, backwards = 0;
  double longest = 0;
  size_t where = 0, first_backwards = 0;
  for (size_t i = 1; i < times.size(); ++i) {
    const double step = seconds_between(times[i - 1], times[i]);
    if (step <= 0 && backwards++ == 0) first_backwards = i;
    if (step <= kGap * median) continue;
    ++gaps;
    if (step > longest) longest = step, where = i;
  }
  lines->emplace_back("gaps in time", gaps == 0
                                          ? "none"
                                          : std::to_string(gaps) + "; the longest is " + fixed(longest, 3) +
                                                " s, before frame " + std::to_string(where));
  if (backwards > 0)
    lines->emplace_back("wrong times", std::to_string(backwards) +
                                           " frames are not after the one before; the first is frame " +
                                           std::to_string(first_backwards));
}

void describe_times(const std::vector<Timestamp>& times, Lines* lines) {
  if (times.size() < 2) return;
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(seconds_between(times[i - 1], times[i]));
  const double usual = median(std::move(steps));
  lines->emplace_back("duration", fixed(seconds_between(times.front(), times.back()), 3) + " s, from " +
                                      to_string(times.front()) + " to " + to_string(times.back()));
  if (usual > 0)
    lines->emplace_back("rate", fixed(1.0 / usual, 2) + " Hz (median step " + fixed(1e3 * usual, 2) + " ms)");
  if (usual > 0) describe_gaps(times, usual, lines);
}

std::string describe_mount(const std::optional<SE3>& T_vehicle_cam) {
  if (!T_vehicle_cam) return "not known (taken to look straight ahead)";
  const Eigen::Vector3d& t = T_vehicle_cam->translation();
  const Eigen::Vector3d axis = T_vehicle_cam->R().col(2);  // optical axis in the vehicle
  return "at x " + fixed(t.x(), 3) + ", y " + fixed(t.y(), 3) + ", z " + fixed(t.z(), 3) + " m; looks " +
         fixed(kDegrees * std::atan2(axis.y(), axis.x()), 1) + " deg to the left and " +
         fixed(kDegrees * std::asin(std::clamp(axis.z(), -1.0, 1.0)), 1) +
         " deg up (vehicle x forward, y left, z up)";
}

}  // namespace

std::pair<double, double> field_of_view_deg(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  // The image reaches half a pixel beyond the centres of its border pixels.
  const double horizontal =
      angle_to_axis(camera, {-0.5, p.cy}) + angle_to_axis(camera, {p.width - 0.5, p.cy});
  const double vertical = angle_to_axis(camera, {p.cx, -0.5}) + angle_to_axis(camera, {p.cx, p.height - 0.5});
  return {kDegrees * horizontal, kDegrees * vertical};
}

std::vector<std::pair<std::string, std::string>> describe(const ImageSource& source) {
  Lines lines;
  lines.emplace_back("kind", source.kind());
  lines.emplace_back("frames", source.size() ? std::to_string(*source.size()) : "not known beforehand");
  describe_camera(source, &lines);
  describe_times(fill_missing(source.times()), &lines);
  lines.emplace_back("mount", describe_mount(source.T_vehicle_cam()));
  for (const InputDecision& d : source.decisions()) {
    lines.emplace_back(d.subject, d.value + (d.reason.empty() ? "" : " (" + d.reason + ")"));
    if (!d.doubt.empty()) lines.emplace_back("WARNING", d.doubt);
  }
  const Lines own = source.details();
  const bool has_truth_detail =
      std::any_of(own.begin(), own.end(), [](const auto& line) { return line.first == "ground truth"; });
  if (!source.ground_truth_path().empty())
    lines.emplace_back("ground truth", source.ground_truth_path());
  else if (!has_truth_detail)
    lines.emplace_back("ground truth", "none");
  lines.insert(lines.end(), own.begin(), own.end());
  return lines;
}

}  // namespace edgevo
