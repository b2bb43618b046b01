// SPDX-License-Identifier: BSD-3-Clause
#include "servo_report.h"

#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"
#include "servo_charts.h"

namespace edgevo {
namespace {

std::string stops_list(const ServoResult& r) {
  std::string html, last;
  for (const ServoRow& row : r.rows) {
    if (row.phase == Phase::kServo && row.command.stop != last && !row.command.stop.empty())
      html += "<li>" + fixed(row.time_s, 2) + " s: " + html_escaped(row.command.stop) + "</li>\n";
    last = row.command.stop;
  }
  return html.empty() ? "<p class=\"note\">The robot was never stopped.</p>\n" : "<ul>" + html + "</ul>\n";
}

std::string tiles(const ServoResult& r) {
  const LatencyFigures latency = latency_figures(r);
  return tiles_html(
      {{r.failure.empty() ? (r.converged ? "converged" : "not converged") : "did not begin",
        "as estimated by the loop"},
       {fixed(r.final_mm, 2) + " mm", "true distance at the end"},
       {fixed(r.final_deg, 3) + "°", "true rotation at the end"},
       {fixed(r.final_px, 2) + " px", "true error of the points, rms"},
       {fixed(r.start_mm, 0) + " mm, " + fixed(r.start_deg, 1) + "°", "at the start"},
       {fixed(r.rows.empty() ? 0 : r.rows.back().time_s, 1) + " s", "whole run"},
       {fixed(latency.p50, 0) + " / " + fixed(latency.p95, 0) + " ms", "latency, median / 95 %"},
       {std::to_string(r.stops), "stops, " + fixed(r.stopped_s, 2) + " s"}});
}

}  // namespace

std::string servo_report(const ServoResult& r, const ServoRunInfo& info,
                         const std::vector<ServoView>& views) {
  std::string body = tiles(r);
  if (!r.failure.empty())
    body += section_html("failure", "Why the loop did not begin",
                         "<p class=\"bad\">" + html_escaped(r.failure) + "</p>\n");
  std::string pictures =
      "<p class=\"note\">Circles: desired positions of the points. Crosses: true positions.</p>\n<div "
      "class=\"edges\">\n";
  for (const ServoView& v : views) pictures += figure_html("png", v.png, v.name + " view", v.name);
  body += section_html("views", "Start, taught and final view", pictures + "</div>\n");
  if (!r.points_start.empty()) {
    std::string charts = state_ribbon(r);
    for (const TimeChart& chart : error_charts(r, info.params)) charts += draw(chart);
    body += section_html("convergence", "Convergence", charts);
    charts.clear();
    for (const TimeChart& chart : loop_charts(r)) charts += draw(chart);
    body += section_html("loop", "Command and age of the pose", charts + stops_list(r));
    body +=
        section_html("path", "Path in the taught camera's axes, seen along its y axis", draw(path_plan(r)));
  }
  body += parameters_html(info.command_line, servo_summary(r, info) + info.params_yaml, {});
  return page_html("edgevo servo", info.params.law + ", the odometry as the only sensor", body);
}

}  // namespace edgevo
