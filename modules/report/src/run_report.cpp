#include "edgevo/report/run_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "advice.h"
#include "edgevo/core/output_file.h"
#include "edgevo/report/chart.h"
#include "edgevo/report/latency_figures.h"
#include "edgevo/report/page.h"
#include "edgevo/report/stage_times.h"
#include "map_section.h"
#include "scale_section.h"
#include "truth_comparison.h"

namespace edgevo {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kMaxPlanPoints = 6000;
const char* const kEstimateColor = "#1f5fbf";
const char* const kTruthColor = "#222222";

// ---- what happened
// ------------------------------------------------------------------------------------------------

std::string color_of(TrackingState state) {
  switch (state) {
    case TrackingState::kTracking:
      return "#2e9e5b";
    case TrackingState::kDegraded:
      return "#e0a100";
    case TrackingState::kLost:
      return "#d0342c";
    case TrackingState::kBootstrapping:
      return "#8a94a6";
  }
  return "";
}

std::vector<double> seconds_of(const Run& run) {
  std::vector<double> seconds;
  for (const FrameRecord& f : run.frames) seconds.push_back(seconds_between(run.frames.front().time, f.time));
  return seconds;
}

std::string state_legend(const Run& run) {
  std::string html = "<p class=\"legend\">";
  for (TrackingState s : {TrackingState::kTracking, TrackingState::kDegraded, TrackingState::kLost,
                          TrackingState::kBootstrapping}) {
    const auto n =
        std::count_if(run.frames.begin(), run.frames.end(), [&](const auto& f) { return f.state == s; });
    html += "<span><i style=\"background:" + color_of(s) + "\"></i>" + std::string(to_string(s)) + ' ' +
            std::to_string(n) + "</span> ";
  }
  return html + "</p>\n";
}

TimeChart chart_of(const Run& run, const std::string& name, const std::string& color,
                   const std::function<double(const FrameRecord&)>& value) {
  TimeChart chart;
  chart.y_name = name;
  chart.x = seconds_of(run);
  chart.from_zero = true;
  Series series{name, color, {}};
  for (const FrameRecord& f : run.frames) series.y.push_back(value(f));
  chart.series = {series};
  return chart;
}

// Nothing where no frame was aligned.
std::string drawn_if_any(const TimeChart& chart) {
  const std::vector<double>& y = chart.series.front().y;
  return std::any_of(y.begin(), y.end(), [](double v) { return std::isfinite(v); }) ? draw(chart) : "";
}

std::string tracking_section(const Run& run) {
  Ribbon ribbon{seconds_of(run), {}};
  for (const FrameRecord& f : run.frames) ribbon.color.push_back(color_of(f.state));
  const auto aligned = [](const FrameRecord& f, double value) { return f.inlier_share > 0 ? value : kNone; };
  const TimeChart inliers =
      chart_of(run, "inlier share", "#1f5fbf", [&](const auto& f) { return aligned(f, f.inlier_share); });
  const TimeChart residual =
      chart_of(run, "residual, px", "#a0408a", [&](const auto& f) { return aligned(f, f.residual_px); });
  const TimeChart edges =
      chart_of(run, "edge pixels", "#5b6b80", [](const auto& f) { return double(f.edges); });
  return section_html(
      "states", "Tracking over the run",
      state_legend(run) + draw(ribbon) + drawn_if_any(inliers) + drawn_if_any(residual) + draw(edges));
}

// ---- where the camera went
// ----------------------------------------------------------------------------------------

// Positions as the page shows them: map axes (x forward, y left, z up), and metres where the truth tells.
struct Path {
  std::string unit;
  double metres_per_unit = 1;
  std::vector<std::optional<Eigen::Vector3d>> estimate, truth;  ///< one for each frame
};

Path path_of(const Run& run, const std::optional<TruthComparison>& truth) {
  Path path;
  path.metres_per_unit = truth ? truth->metres_per_unit : 1;
  path.unit = run.is_metric() || truth ? "m" : "units";
  const SE3 T = T_map_world(run);
  for (size_t i = 0; i < run.frames.size(); ++i) {
    const auto& pose = run.frames[i].T_world_cam;
    const bool posed = pose && pose->is_finite();
    path.estimate.push_back(
        posed ? std::optional<Eigen::Vector3d>(path.metres_per_unit * (T * pose->translation()))
              : std::nullopt);
    path.truth.push_back(truth && truth->p_world[i] ? std::optional<Eigen::Vector3d>(T * *truth->p_world[i])
                                                    : std::nullopt);
  }
  return path;
}

// Pieces between gaps and between segments.
PlanLine plan_line(const std::string& name, const char* color, const Run& run,
                   const std::vector<std::optional<Eigen::Vector3d>>& positions, bool by_segment) {
  PlanLine line{name, color, false, {}};
  const Eigen::Vector3d* last = nullptr;
  for (size_t i = 0; i < positions.size(); ++i) {
    if (!positions[i]) {
      last = nullptr;
      continue;
    }
    const bool joins = last && (!by_segment || run.frames[i].segment == run.frames[i - 1].segment);
    if (!joins) line.pieces.emplace_back();
    line.pieces.back().emplace_back(positions[i]->x(), positions[i]->y());
    last = &*positions[i];
  }
  return line;
}

// Every k-th of the points of all keyframes.
std::vector<std::pair<double, double>> plan_points(const Run& run, const PointFilter& filter,
                                                   double metres_per_unit) {
  size_t total = 0, seen = 0;
  for (const KeyframeRecord& k : run.keyframes) total += k.points.size();
  const size_t step = std::max<size_t>(1, total / kMaxPlanPoints);
  const SE3 T = T_map_world(run);
  std::vector<std::pair<double, double>> points;
  for (const KeyframeRecord& k : run.keyframes)
    for (const EdgePoint& p : k.points) {
      if (seen++ % step != 0 || !filter.keeps(p)) continue;
      const Eigen::Vector3d p_map = metres_per_unit * (T * (k.T_world_cam * point_in_camera(run.pinhole, p)));
      points.emplace_back(p_map.x(), p_map.y());
    }
  return points;
}

TimeChart position_chart(const Run& run, const Path& path, int axis) {
  const char* const names[] = {"forward", "left", "up"};
  TimeChart chart;
  chart.y_name = names[axis] + std::string(", ") + path.unit;
  chart.x = seconds_of(run);
  Series estimate{"estimate", kEstimateColor, {}}, truth{"ground truth", kTruthColor, {}};
  bool has_truth = false;
  for (size_t i = 0; i < path.estimate.size(); ++i) {
    estimate.y.push_back(path.estimate[i] ? (*path.estimate[i])[axis] : kNone);
    truth.y.push_back(path.truth[i] ? (*path.truth[i])[axis] : kNone);
    has_truth |= path.truth[i].has_value();
  }
  if (has_truth) chart.series.push_back(truth);
  chart.series.push_back(estimate);
  return chart;
}

std::string truth_statement(const Run& run, const std::optional<TruthComparison>& truth,
                            const std::string& why_not) {
  if (!truth)
    return why_not.empty() ? note_html("No ground truth is known for this source.")
                           : note_html("No comparison with ground truth: " + why_not);
  return note_html(
      "Ground truth is aligned with the run (" +
      std::string(run.is_metric() ? "SE(3), metres as they are" : "Sim(3)") + "): " + "ATE " +
      fixed(truth->error.rmse, 4) + " m rms, " + fixed(truth->error.max, 4) + " m at most, over " +
      std::to_string(truth->error.poses) + " poses" +
      (run.is_metric() ? "." : "; one unit of the run is " + fixed(truth->metres_per_unit, 4) + " m."));
}

std::string trajectory_section(const ReportInput& in, const std::optional<TruthComparison>& truth,
                               const std::string& why_not) {
  const Path path = path_of(in.run, truth);
  if (std::none_of(path.estimate.begin(), path.estimate.end(), [](const auto& p) { return p.has_value(); }))
    return section_html(
        "trajectory", "Trajectory",
        "<p class=\"bad\">No frame has a pose.</p>\n" + truth_statement(in.run, truth, why_not));
  Plan plan{path.unit, plan_points(in.run, in.points, path.metres_per_unit), {}};
  if (truth) plan.lines.push_back(plan_line("ground truth", kTruthColor, in.run, path.truth, false));
  plan.lines.push_back(plan_line("estimate", kEstimateColor, in.run, path.estimate, true));
  plan.lines.back().dashed = truth.has_value();
  std::string body =
      truth_statement(in.run, truth, why_not) + "<h3>From above</h3>\n" + draw(plan) + "<h3>Over time</h3>\n";
  for (int axis = 0; axis < 3; ++axis) body += draw(position_chart(in.run, path, axis));
  return section_html("trajectory", "Trajectory", body);
}

// ---- what it saw, what it cost
// --------------------------------------------------------------------------------------

std::string edges_section(const ReportInput& in) {
  const EdgePictures& p = in.pictures;
  if (p.pictures.empty())
    return section_html("edges", "Edges",
                        note_html("There is no keyframe with points and an image to show."));
  const std::string unit = in.run.is_metric() ? " m" : " units";
  std::string body = "<div class=\"scale\" style=\"background:" + idepth_gradient_css() +
                     "\"></div><div class=\"ends\"><span>far, " + fixed(1 / p.idepth_low, 2) + unit +
                     "</span><span>inverse depth</span><span>near, " + fixed(1 / p.idepth_high, 2) + unit +
                     "</span></div>\n<div class=\"edges\">\n";
  for (const EdgePicture& e : p.pictures)
    body += figure_html("jpeg", e.jpeg, "edges of frame " + std::to_string(e.frame_index),
                        "frame " + std::to_string(e.frame_index) + ", " +
                            fixed(seconds_between(in.run.frames.front().time, e.time), 2) +
                            " s: " + std::to_string(e.points) + " points");
  return section_html("edges", "Edges by inverse depth", body + "</div>\n");
}

std::string stage_table(const Run& run) {
  std::string html =
      "<table><tr><th>stage</th><th>frames</th><th>mean ms</th><th>median</th><th>95 "
      "%</th><th>max</th></tr>\n";
  for (auto [name, ms] : stage_times(run)) {
    std::sort(ms.begin(), ms.end());
    double sum = 0;
    for (double v : ms) sum += v;
    html += "<tr><td>" + html_escaped(name) + "</td><td>" + std::to_string(ms.size()) + "</td>";
    for (double v : {sum / double(ms.size()), percentile(ms, 0.5), percentile(ms, 0.95), ms.back()})
      html += "<td>" + fixed(v, 2) + "</td>";
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::vector<double> total_ms(const Run& run) {
  std::vector<double> totals;
  for (const FrameRecord& f : run.frames) {
    totals.push_back(0);
    for (const auto& stage : f.stage_ms) totals.back() += stage.second;
  }
  return totals;
}

std::string timing_section(const Run& run) {
  static const char* const kColors[] = {"#1f5fbf", "#2e9e5b", "#e0a100", "#a0408a", "#d06a2c",
                                        "#2aa3b8", "#7b5fc4", "#5b6b80", "#b8426a", "#8c9a3a"};
  if (stages_of(run).empty()) return section_html("timing", "Time", note_html("No stage ran."));
  TimeChart chart;
  chart.y_name = "CPU ms a frame";
  chart.x = seconds_of(run);
  chart.stacked = true;
  const std::vector<std::string> stages = stages_of(run);
  for (size_t s = 0; s < stages.size(); ++s) {
    Series series{stages[s], kColors[s % std::size(kColors)], {}};
    for (const FrameRecord& f : run.frames) {
      double sum = 0;
      for (const auto& [name, ms] : f.stage_ms)
        if (name == stages[s]) sum += ms;
      series.y.push_back(sum);
    }
    chart.series.push_back(series);
  }
  std::vector<double> totals = total_ms(run);
  std::sort(totals.begin(), totals.end());
  chart.y_max = 1.5 * percentile(totals, 0.98);
  const bool cut = totals.back() > chart.y_max;
  return section_html("timing", "Time by stage",
                      (run.realtime ? note_html("Two threads: " + latency_statement(run) + ".") : "") + draw(chart) +
                          (cut ? note_html("The largest frame takes " + fixed(totals.back(), 0) +
                                           " ms and leaves the drawing.")
                               : "") +
                          stage_table(run));
}

// ---- advice, the tiles
// -------------------------------------------------------------------------------------

std::string advice_section(const ReportInput& in) {
  std::string body = "<ul>\n";
  for (const std::string& file : in.not_written)
    body +=
        "<li class=\"bad\">" + html_escaped(file) + " could not be written: free space and run again.</li>\n";
  for (const Advice& a : advise(in.run, in.info))
    body += "<li>" + html_escaped(a.text) +
            (a.command.empty() ? "" : " <code>" + html_escaped(a.command) + "</code>") + "</li>\n";
  return section_html("next", "What to do next", body + "</ul>\n");
}

double path_length(const Path& path, const Run& run) {
  double length = 0;
  size_t last = path.estimate.size();
  for (size_t i = 0; i < path.estimate.size(); ++i) {
    if (!path.estimate[i]) continue;
    if (last < i && run.frames[last].segment == run.frames[i].segment)
      length += (*path.estimate[i] - *path.estimate[last]).norm();
    last = i;
  }
  return length;
}

std::string tiles(const Run& run, const std::optional<TruthComparison>& truth) {
  const Path path = path_of(run, truth);
  const auto posed =
      std::count_if(path.estimate.begin(), path.estimate.end(), [](const auto& p) { return p.has_value(); });
  int segments = 0;
  size_t points = 0;
  for (const FrameRecord& f : run.frames) segments = std::max(segments, f.segment + 1);
  for (const KeyframeRecord& k : run.keyframes) points += k.points.size();
  double ms = 0;
  for (double t : total_ms(run)) ms += t;
  const double frames = std::max<double>(1, double(run.frames.size()));
  std::vector<std::pair<std::string, std::string>> tiles{
      {std::to_string(run.frames.size()), "frames"},
      {fixed(100 * double(posed) / frames, 1) + " %", "have a pose"},
      {std::to_string(segments), segments == 1 ? "segment" : "segments"},
      {fixed(path_length(path, run), 2) + ' ' + path.unit, "path length"},
      {std::to_string(run.keyframes.size()), "keyframes"},
      {std::to_string(points), "edge points"},
      {fixed(ms / frames, 1) + " ms", "CPU a frame"}};
  if (truth)
    tiles.emplace_back(fixed(truth->error.rmse, 3) + " m", run.is_metric() ? "ATE, SE(3)" : "ATE, Sim(3)");
  return tiles_html(tiles);
}

}  // namespace

std::string report_html(const ReportInput& in) {
  std::string why_not;
  const std::optional<TruthComparison> truth =
      compare_with_truth(in.run, in.info.ground_truth_path, &why_not);
  std::string body =
      tiles(in.run, truth) + advice_section(in) + trajectory_section(in, truth, why_not) + edges_section(in) + map_section(in.run, in.map);
  if (!in.run.frames.empty()) body += tracking_section(in.run) + timing_section(in.run);
  body += scale_section(in.run) + parameters_html(in.info.command_line, in.info.params_yaml, in.info.notes);
  return page_html("edgevo run", in.info.source_kind + " " + in.info.source_path, body);
}

}  // namespace edgevo
