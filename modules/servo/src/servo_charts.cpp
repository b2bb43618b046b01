// SPDX-License-Identifier: BSD-3-Clause
#include "servo_charts.h"

#include <cmath>
#include <functional>
#include <limits>

#include "edgevo/report/palette.h"

namespace edgevo {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TimeChart servo_chart(const ServoResult& r, const std::string& y_name,
                      const std::vector<std::pair<Series, std::function<double(const ServoRow&)>>>& series) {
  TimeChart chart;
  chart.y_name = y_name;
  chart.from_zero = true;
  for (const ServoRow& row : r.rows)
    if (row.phase == Phase::kServo) chart.x.push_back(row.time_s);
  for (const auto& [style, value] : series) {
    chart.series.push_back(style);
    for (const ServoRow& row : r.rows)
      if (row.phase == Phase::kServo) chart.series.back().y.push_back(value(row));
  }
  return chart;
}

double while_steered(const ServoRow& row, double value) { return row.command.stop.empty() ? value : kNone; }

double norm(const vpColVector& v, unsigned begin) {
  return std::sqrt(v[begin] * v[begin] + v[begin + 1] * v[begin + 1] + v[begin + 2] * v[begin + 2]);
}

}  // namespace

std::vector<TimeChart> error_charts(const ServoResult& r, const ServoParams& params) {
  const Series truth{"true", palette::kInk, {}}, believed{"as estimated by the loop", palette::kBlue, {}};
  if (params.law == "ibvs")
    return {
        servo_chart(r, "from goal, mm", {{truth, [](const auto& row) { return row.true_mm; }}}),
        servo_chart(r, "from goal, deg", {{truth, [](const auto& row) { return row.true_deg; }}}),
        servo_chart(r, "points, px rms",
                    {{believed, [](const auto& row) { return while_steered(row, row.command.image_px); }}})};
  return {
      servo_chart(
          r, "from goal, mm",
          {{truth, [](const auto& row) { return row.true_mm; }},
           {believed, [](const auto& row) { return while_steered(row, 1000 * row.command.translation_m); }}}),
      servo_chart(
          r, "from goal, deg",
          {{truth, [](const auto& row) { return row.true_deg; }},
           {believed, [](const auto& row) { return while_steered(row, row.command.rotation_deg); }}})};
}

std::vector<TimeChart> loop_charts(const ServoResult& r) {
  return {servo_chart(r, "speed, mm/s",
                      {{{"speed", palette::kPurple, {}},
                        [](const auto& row) { return 1000 * norm(row.command.velocity, 0); }}}),
          servo_chart(
              r, "ms",
              {{{"age of the pose", palette::kBlue, {}}, [](const auto& row) { return 1000 * row.age_s; }},
               {{"odometry", palette::kOrange, {}},
                [](const auto& row) { return row.latency_s > 0 ? 1000 * row.latency_s : kNone; }}})};
}

std::string state_ribbon(const ServoResult& r) {
  Ribbon ribbon;
  for (const ServoRow& row : r.rows) {
    if (row.phase != Phase::kServo) continue;
    ribbon.x.push_back(row.time_s);
    ribbon.color.push_back(!row.command.stop.empty()               ? palette::kRed
                           : row.state == TrackingState::kDegraded ? palette::kAmber
                                                                   : palette::kGreen);
  }
  return "<p class=\"legend\"><span><i style=\"background:#2e9e5b\"></i>steered, TRACKING</span> <span><i "
         "style=\"background:#e0a100\"></i>steered, DEGRADED</span> <span><i "
         "style=\"background:#d0342c\"></i>stopped</span></p>\n" +
         draw(ribbon);
}

Plan path_plan(const ServoResult& r) {
  Plan plan{"mm", {}, {}};
  PlanLine away{"moved by hand", palette::kGray, true, {{}}}, servo{"steered", palette::kBlue, false, {{}}};
  const ServoRow* taught = nullptr;
  for (const ServoRow& row : r.rows)
    if (row.phase == Phase::kAway && !taught) taught = &row;
  if (!taught) return plan;
  for (const ServoRow& row : r.rows) {
    if (row.phase == Phase::kTeach) continue;
    const Eigen::Vector3d p = 1000 * (taught->T_scene_cam.inverse() * row.T_scene_cam).translation();
    (row.phase == Phase::kAway ? away : servo).pieces.back().emplace_back(p.z(), -p.x());
  }
  plan.lines = {away, servo};
  return plan;
}

std::string convergence_svg(const ServoResult& r, const ServoParams& params) {
  std::string inner;
  int row = 0;
  for (const TimeChart& chart : error_charts(r, params)) {
    const std::string svg = draw_svg(chart);
    inner +=
        "<g transform=\"translate(0 " + std::to_string(200 * row++) + ")\">" + svg.substr(svg.find('>') + 1);
    inner.erase(inner.rfind("</svg>"));
    inner += "</g>\n";
  }
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1000 " + std::to_string(200 * row) +
         "\" font-family=\"sans-serif\" "
         "font-size=\"12\">\n<style>.grid{stroke:#e6e9ef;fill:none}.line{fill:none;stroke-width:1.8}</"
         "style>\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
         "<text x=\"980\" y=\"24\" text-anchor=\"end\">black: true; blue: as estimated by the loop</text>\n" +
         inner + "</svg>\n";
}

}  // namespace edgevo
