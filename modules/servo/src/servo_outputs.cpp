#include "edgevo/servo/servo_outputs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/output_file.h"
#include "edgevo/report/chart.h"
#include "edgevo/report/page.h"
#include "edgevo/report/stage_times.h"
#include "edgevo/results/yaml_writer.h"

namespace edgevo {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

const char* name_of(Phase phase) {
  switch (phase) {
    case Phase::kTeach:
      return "teach";
    case Phase::kAway:
      return "away";
    case Phase::kServo:
      return "servo";
  }
  return "";
}

std::string one_cell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '"' || c == '\n'; }, ';');
  return text;
}

// ---- the three views
// --------------------------------------------------------------------------------------------------

cv::Point2d pixel(const Camera& camera, const Eigen::Vector2d& undistorted_px) {
  const Pinhole& p = camera.pinhole;
  const Eigen::Vector2d x = camera.distort(p.ray(undistorted_px).head<2>());
  return {p.fx * x.x() + p.cx, p.fy * x.y() + p.cy};
}

// Drawn to a sixteenth of a pixel.
cv::Point fine(const cv::Point2d& p) { return {int(std::lround(16 * p.x)), int(std::lround(16 * p.y))}; }

std::vector<uint8_t> view_png(const Camera& camera, const GrayImage& image,
                              const std::vector<Eigen::Vector2d>& now,
                              const std::vector<Eigen::Vector2d>& wanted) {
  const cv::Mat gray(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data()));
  cv::Mat picture;
  cv::cvtColor(gray, picture, cv::COLOR_GRAY2BGR);
  for (const Eigen::Vector2d& px : wanted)
    cv::circle(picture, fine(pixel(camera, px)), 16 * 7, {60, 200, 60}, 2, cv::LINE_AA, 4);
  for (const Eigen::Vector2d& px : now) {
    const cv::Point2d p = pixel(camera, px);
    cv::line(picture, fine(p - cv::Point2d(5, 5)), fine(p + cv::Point2d(5, 5)), {40, 60, 230}, 1, cv::LINE_AA,
             4);
    cv::line(picture, fine(p - cv::Point2d(5, -5)), fine(p + cv::Point2d(5, -5)), {40, 60, 230}, 1,
             cv::LINE_AA, 4);
  }
  std::vector<uint8_t> png;
  cv::imencode(".png", picture, png);
  return png;
}

struct View {
  std::string name;
  std::vector<uint8_t> png;
};

std::vector<View> views_of(const ServoResult& r) {
  std::vector<View> views;
  if (!r.start.empty())
    views.push_back({"start", view_png(r.camera, r.start, r.points_start, r.points_taught)});
  if (!r.taught.empty())
    views.push_back({"taught", view_png(r.camera, r.taught, r.points_taught, r.points_taught)});
  if (!r.final.empty())
    views.push_back({"final", view_png(r.camera, r.final, r.points_final, r.points_taught)});
  return views;
}

// ---- charts
// -------------------------------------------------------------------------------------------------------------

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

std::vector<TimeChart> error_charts(const ServoResult& r, const ServoParams& params) {
  const Series truth{"true", "#222222", {}}, believed{"as the loop sees it", "#1f5fbf", {}};
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

double norm(const vpColVector& v, unsigned begin) {
  return std::sqrt(v[begin] * v[begin] + v[begin + 1] * v[begin + 1] + v[begin + 2] * v[begin + 2]);
}

std::vector<TimeChart> loop_charts(const ServoResult& r) {
  return {servo_chart(r, "speed, mm/s",
                      {{{"speed", "#a0408a", {}},
                        [](const auto& row) { return 1000 * norm(row.command.velocity, 0); }}}),
          servo_chart(r, "ms",
                      {{{"age of the pose", "#1f5fbf", {}}, [](const auto& row) { return 1000 * row.age_s; }},
                       {{"odometry", "#d06a2c", {}},
                        [](const auto& row) { return row.latency_s > 0 ? 1000 * row.latency_s : kNone; }}})};
}

std::string state_ribbon(const ServoResult& r) {
  Ribbon ribbon;
  for (const ServoRow& row : r.rows) {
    if (row.phase != Phase::kServo) continue;
    ribbon.x.push_back(row.time_s);
    ribbon.color.push_back(!row.command.stop.empty()               ? "#d0342c"
                           : row.state == TrackingState::kDegraded ? "#e0a100"
                                                                   : "#2e9e5b");
  }
  return "<p class=\"legend\"><span><i style=\"background:#2e9e5b\"></i>steered, TRACKING</span> <span><i "
         "style=\"background:#e0a100\"></i>steered, "
         "DEGRADED</span> <span><i style=\"background:#d0342c\"></i>stopped</span></p>\n" +
         draw(ribbon);
}

// The camera's true path in the taught camera's axes, seen along its y axis: z forward, -x left.
Plan path_plan(const ServoResult& r) {
  Plan plan{"mm", {}, {}};
  PlanLine away{"moved away by hand", "#8a94a6", true, {{}}}, servo{"steered", "#1f5fbf", false, {{}}};
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
        "as the loop sees it"},
       {fixed(r.final_mm, 2) + " mm", "true distance at the end"},
       {fixed(r.final_deg, 3) + "°", "true rotation at the end"},
       {fixed(r.final_px, 2) + " px", "fed points, true, rms"},
       {fixed(r.start_mm, 0) + " mm, " + fixed(r.start_deg, 1) + "°", "at the start"},
       {fixed(r.rows.empty() ? 0 : r.rows.back().time_s, 1) + " s", "whole run"},
       {fixed(latency.p50, 0) + " / " + fixed(latency.p95, 0) + " ms", "latency, median / 95 %"},
       {std::to_string(r.stops), "stops, " + fixed(r.stopped_s, 2) + " s"}});
}

std::string servo_report(const ServoResult& r, const ServoRunInfo& info, const std::vector<View>& views) {
  std::string body = tiles(r);
  if (!r.failure.empty())
    body += section_html("failure", "Why it did not begin",
                         "<p class=\"bad\">" + html_escaped(r.failure) + "</p>\n");
  std::string pictures =
      "<p class=\"note\">Circles: where the fed points are wanted. Crosses: where they truly are.</p>\n<div "
      "class=\"edges\">\n";
  for (const View& v : views) pictures += figure_html("png", v.png, v.name + " view", v.name);
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

// The error charts below each other in one drawing that stands alone.
std::string convergence_svg(const ServoResult& r, const ServoParams& params) {
  std::string inner;
  int row = 0;
  for (const TimeChart& chart : error_charts(r, params)) {
    const std::string html = draw(chart);
    inner += "<g transform=\"translate(0 " + std::to_string(200 * row++) + ")\">" +
             html.substr(html.find('>', html.find("<svg")) + 1);
    inner.erase(inner.rfind("</svg>"));
    inner += "</g>\n";
  }
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1000 " + std::to_string(200 * row) +
         "\" font-family=\"sans-serif\" "
         "font-size=\"12\">\n<style>.grid{stroke:#e6e9ef;fill:none}.line{fill:none;stroke-width:1.8}</"
         "style>\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
         "<text x=\"980\" y=\"24\" text-anchor=\"end\">black: true; blue: as the loop sees it</text>\n" +
         inner + "</svg>\n";
}

std::string as_text(const std::vector<uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

LatencyFigures latency_figures(const ServoResult& result) {
  std::vector<double> ms;
  for (const ServoRow& row : result.rows)
    if (row.phase == Phase::kServo && row.latency_s > 0) ms.push_back(1000 * row.latency_s);
  return latency_figures(std::move(ms)).value_or(LatencyFigures());
}

std::string servo_csv(const ServoResult& result) {
  std::string text =
      "time,phase,state,age_ms,latency_ms,true_mm,true_deg,seen_mm,seen_deg,seen_px,vx,vy,vz,wx,wy,wz,x,y,z,"
      "qx,qy,qz,qw,stop\n";
  for (const ServoRow& row : result.rows) {
    text += fixed(row.time_s, 4) + ',' + name_of(row.phase) + ',' + std::string(to_string(row.state));
    const Command& c = row.command;
    for (double v : {1000 * row.age_s, 1000 * row.latency_s, row.true_mm, row.true_deg,
                     1000 * c.translation_m, c.rotation_deg, c.image_px})
      append_fixed(&(text += ','), v, 4);
    for (unsigned i = 0; i < 6; ++i) append_fixed(&(text += ','), c.velocity[i], 6);
    for (int i = 0; i < 3; ++i) append_fixed(&(text += ','), row.T_scene_cam.translation()[i], 6);
    for (int i = 0; i < 4; ++i) append_fixed(&(text += ','), row.T_scene_cam.rotation().coeffs()[i], 8);
    text += ',' + one_cell(c.stop) + '\n';
  }
  return text;
}

std::string servo_summary(const ServoResult& r, const ServoRunInfo& info) {
  const LatencyFigures latency = latency_figures(r);
  const ServoParams& p = info.params;
  std::string y = "servo:\n  law: " + p.law + "\n  result: " +
                  (r.failure.empty() ? (r.converged ? "converged" : "not_converged") : "not_begun") +
                  "\n  failure: " + yaml_quoted(r.failure) + "\n";
  const auto number = [&](const char* key, double value, int decimals) {
    y += std::string("  ") + key + ": " + fixed(value, decimals) + '\n';
  };
  number("final_mm", r.final_mm, 3);
  number("final_deg", r.final_deg, 4);
  number("final_px", r.final_px, 3);
  number("start_mm", r.start_mm, 1);
  number("start_deg", r.start_deg, 2);
  number("start_px", r.start_px, 1);
  number("duration_s", r.rows.empty() ? 0 : r.rows.back().time_s, 2);
  number("stops", r.stops, 0);
  number("stopped_s", r.stopped_s, 2);
  number("images_replaced", r.replaced, 0);
  number("latency_ms_median", latency.p50, 1);
  number("latency_ms_p95", latency.p95, 1);
  number("latency_ms_max", latency.max, 1);
  number("metres_per_unit", r.metres_per_unit, 6);
  number("scale_error", p.scale_error, 4);
  number("rate_hz", p.rate_hz, 2);
  number("gain", p.gain, 2);
  number("blackout_s", p.blackout_s, 2);
  return y + "  latency: " +
         (p.latency_s     ? "given"
          : p.cpu_latency ? "measured, CPU time"
                          : "measured") +
         "\n  light: " + (p.light.empty() ? "none" : p.light) + "\n  seed: " + std::to_string(p.seed) + "\n";
}

void write_servo_outputs(const std::string& folder, const ServoResult& result, const ServoRunInfo& info) {
  const auto path = [&](const std::string& name) { return (std::filesystem::path(folder) / name).string(); };
  write_file(path("servo.csv"), servo_csv(result));
  write_file(path("summary.yaml"), servo_summary(result, info) + "odometry:\n" + info.params_yaml);
  const std::vector<View> views = views_of(result);
  for (const View& v : views) write_file(path(v.name + ".png"), as_text(v.png));
  if (!result.points_start.empty()) write_file(path("convergence.svg"), convergence_svg(result, info.params));
  write_file(path("report.html"), servo_report(result, info, views));
}

}  // namespace edgevo
