// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/describe.h"

#include <algorithm>
#include <cmath>

#include "assumed_camera.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/target_pinhole.h"
#include "edgevo/core/time_order.h"
#include "edgevo/datasets/gyro_file.h"
#include "lens_text.h"

namespace edgevo {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

// Six significant digits, as calibrations are read by people.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return text;
}

// "k1 0.1, k2 -0.2, p1 0, p2 0, k3 0 (plumb-bob)"
std::string describe_distortion(const CameraModel& model) {
  const StatedLens lens = stated_lens(model);
  if (lens.kind == LensKind::kPinhole) return "none";
  const std::vector<std::string> names = coefficient_names(lens.kind);
  std::string text;
  for (size_t i = 0; i < lens.coefficients.size(); ++i)
    text += (i == 0 ? "" : ", ") + names[i] + " " + number(lens.coefficients[i]);
  return text + " (" + (lens.kind == LensKind::kPlumbBob ? "plumb-bob" : to_string(model)) + ")";
}

// Angle between the optical axis and a pixel, radians.
double angle_to_axis(const Camera& camera, const Eigen::Vector2d& px) {
  const Eigen::Vector3d ray = camera.unproject(px).value_or(camera.pinhole().ray(px));
  return std::atan2(ray.head<2>().norm(), ray.z());
}

void describe_camera(const ImageSource& source, Lines* lines) {
  const Camera& camera = source.camera();
  if (knows_camera(source)) {
    for (const auto& line : describe_numbers(camera)) lines->push_back(line);
    return;
  }
  lines->emplace_back("image size", std::to_string(camera.width) + " x " + std::to_string(camera.height));
}

void describe_gaps(const std::vector<Timestamp>& times, double median, Lines* lines) {
  constexpr double kGap = 2.5;  // median steps: a single missing frame is not a gap
  int gaps = 0;
  double longest = 0;
  size_t where = 0;
  for (size_t i = 1; i < times.size(); ++i) {
    const double step = seconds_between(times[i - 1], times[i]);
    if (step <= kGap * median) continue;
    ++gaps;
    if (step > longest) longest = step, where = i;
  }
  lines->emplace_back("gaps in time", gaps == 0
                                          ? "none"
                                          : std::to_string(gaps) + "; the longest is " + fixed(longest, 3) +
                                                " s, before frame " + std::to_string(where));
}

void describe_wrong_times(const std::vector<Timestamp>& times, Lines* lines) {
  int wrong = 0;
  size_t first = 0;
  for (size_t i = 1; i < times.size(); ++i)
    if (!(times[i - 1] < times[i]) && wrong++ == 0) first = i;
  if (wrong > 0)
    lines->emplace_back("wrong times", std::to_string(wrong) +
                                           " frames are not after the one before; the first is frame " +
                                           std::to_string(first));
}

void describe_times(const std::vector<Timestamp>& times, Lines* lines) {
  if (times.size() < 2) return;
  std::vector<double> steps;
  double duration = 0;  // of a clock that was set back: without the step
  for (size_t i = 1; i < times.size(); ++i) {
    steps.push_back(seconds_between(times[i - 1], times[i]));
    duration += std::max(steps.back(), 0.0);
  }
  const double usual = median(std::move(steps));
  lines->emplace_back("duration", fixed(duration, 3) + " s, from " + to_string(times.front()) + " to " +
                                      to_string(times.back()));
  if (usual > 0)
    lines->emplace_back("rate", fixed(1.0 / usual, 2) + " Hz (median step " + fixed(1e3 * usual, 2) + " ms)");
  if (usual > 0) describe_gaps(times, usual, lines);
  describe_wrong_times(times, lines);
}

std::string describe_mount(const std::optional<SE3>& T_vehicle_cam) {
  if (!T_vehicle_cam) return "not known (taken to look straight ahead)";
  const Eigen::Vector3d& t = T_vehicle_cam->translation();
  const Eigen::Vector3d axis = T_vehicle_cam->R().col(2);  // optical axis in the vehicle
  return "at x " + fixed(t.x(), 3) + ", y " + fixed(t.y(), 3) + ", z " + fixed(t.z(), 3) + " m; looks " +
         fixed(deg(std::atan2(axis.y(), axis.x())), 1) + " deg to the left and " +
         fixed(deg(std::asin(std::clamp(axis.z(), -1.0, 1.0))), 1) +
         " deg up (vehicle x forward, y left, z up)";
}

// A decision on something that has a line of its own is added to it.
void describe_decision(const InputDecision& d, Lines* lines) {
  const std::string text = d.value + (d.reason.empty() ? "" : " (" + d.reason + ")");
  const auto own =
      std::find_if(lines->begin(), lines->end(), [&](const auto& line) { return line.first == d.subject; });
  if (own == lines->end())
    lines->emplace_back(d.subject, text);
  else
    own->second += "; " + text;
  if (!d.doubt.empty()) lines->emplace_back("WARNING", d.subject + ": " + d.doubt);
}

}  // namespace

std::pair<double, double> field_of_view_deg(const Camera& camera) {
  if (!camera.plumb_bob()) {
    const ViewAngles view = view_angles(camera);
    return {deg(view.horizontal()), deg(view.vertical())};
  }
  const Pinhole p = camera.pinhole();
  // The image reaches half a pixel beyond the centres of its border pixels.
  const double horizontal =
      angle_to_axis(camera, {-0.5, p.cy}) + angle_to_axis(camera, {p.width - 0.5, p.cy});
  const double vertical = angle_to_axis(camera, {p.cx, -0.5}) + angle_to_axis(camera, {p.cx, p.height - 0.5});
  return {deg(horizontal), deg(vertical)};
}

std::vector<std::pair<std::string, std::string>> describe_numbers(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  const auto [horizontal, vertical] = field_of_view_deg(camera);
  return {{"image size", std::to_string(p.width) + " x " + std::to_string(p.height)},
          {"camera", "fx " + number(p.fx) + ", fy " + number(p.fy) + ", cx " + number(p.cx) + ", cy " +
                         number(p.cy) + " px"},
          {"distortion", describe_distortion(camera.model)},
          {"field of view", fixed(horizontal, 1) + " x " + fixed(vertical, 1) + " deg"}};
}

std::vector<std::pair<std::string, std::string>> describe(const ImageSource& source) {
  Lines lines;
  lines.emplace_back("kind", source.kind());
  lines.emplace_back("frames", source.size() ? std::to_string(*source.size()) : "not known beforehand");
  describe_camera(source, &lines);
  describe_times(fill_missing(source.times()), &lines);
  lines.emplace_back("mount", describe_mount(source.T_vehicle_cam()));
  for (const InputDecision& decision : source.decisions()) describe_decision(decision, &lines);
  const Lines own = source.details();
  const bool has_truth_detail =
      std::any_of(own.begin(), own.end(), [](const auto& line) { return line.first == "ground truth"; });
  if (!source.ground_truth_path().empty())
    lines.emplace_back("ground truth", source.ground_truth_path());
  else if (!has_truth_detail)
    lines.emplace_back("ground truth", "none");
  lines.insert(lines.end(), own.begin(), own.end());
  const Lines gyro = describe_gyro(source.gyro_readings());
  lines.insert(lines.end(), gyro.begin(), gyro.end());
  return lines;
}

}  // namespace edgevo
