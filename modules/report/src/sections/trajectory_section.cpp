// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory_section.h"

#include <algorithm>
#include <limits>

#include "edgevo/core/output_file.h"
#include "edgevo/evaluation/evaluate.h"
#include "edgevo/report/chart.h"
#include "edgevo/report/page.h"
#include "edgevo/report/palette.h"
#include "edgevo/report/plan.h"
#include "frame_times.h"

namespace edgevo {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kMaxPlanPoints = 6000;
const char* const kEstimateColor = palette::kBlue;
const char* const kTruthColor = palette::kInk;

// A line with a piece for each part between gaps and between segments.
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

// Every k-th point of all keyframes.
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

TimeChart position_chart(const Run& run, const ShownPath& path, int axis) {
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

// Distance of each frame from its true position.
TimeChart error_chart(const Run& run, const ShownPath& path) {
  TimeChart chart;
  chart.y_name = "distance from the truth, " + path.unit;
  chart.x = seconds_of(run);
  chart.from_zero = true;
  Series error{"error", palette::kRed, {}};
  for (size_t i = 0; i < path.estimate.size(); ++i)
    error.y.push_back(path.estimate[i] && path.truth[i] ? (*path.estimate[i] - *path.truth[i]).norm()
                                                        : kNone);
  chart.series = {error};
  return chart;
}

std::string drift_table(const std::optional<Drift>& drift) {
  if (!drift) return "";
  std::vector<std::vector<std::string>> rows;
  for (size_t i = 0; i < drift->lengths_m.size(); ++i) {
    const Drift::OfLength& d = drift->by_length[i];
    if (d.intervals == 0) continue;
    rows.push_back({fixed(drift->lengths_m[i], drift->lengths_m[i] < 2 ? 3 : 1) + " m",
                    std::to_string(d.intervals), fixed(d.mean_cm_per_m, 2), fixed(d.median_cm_per_m, 2),
                    fixed(d.max_cm_per_m, 2)});
  }
  return "<h3>Drift by length of the interval</h3>\n" +
         table_html({"interval", "number", "mean cm/m", "median", "max"}, rows) +
         note_html("All lengths together: " + fixed(drift->mean_cm_per_m, 2) + " cm/m, over " +
                   std::to_string(drift->intervals) + " intervals of a true path of " +
                   fixed(drift->path_m, 1) + " m, the scale re-corrected every " +
                   std::to_string(EvaluationOptions().rescale_block_frames) +
                   " frames, as edgevo eval does it.");
}

std::string error_part(const Run& run, const ShownPath& path, const TruthComparison& truth) {
  return "<h3>Error over time</h3>\n" + draw(error_chart(run, path)) + drift_table(truth.drift);
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

}  // namespace

std::string trajectory_section(const ReportInput& in, const std::optional<TruthComparison>& truth,
                               const std::string& why_not) {
  const ShownPath path = path_of(in.run, truth);
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
  if (truth) body += error_part(in.run, path, *truth);
  return section_html("trajectory", "Trajectory", body);
}

}  // namespace edgevo
