// SPDX-License-Identifier: BSD-3-Clause
// The evaluation as aligned text.
#include <cmath>
#include <cstdio>
#include <sstream>

#include "edgevo/evaluation/evaluate.h"

namespace edgevo {
namespace {

struct Row {
  std::string metric, value, unit, over, alignment;
};

std::string number(double value, const char* format = "%.4f") {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string poses(int count) { return std::to_string(count) + " poses"; }
std::string intervals(int count) { return std::to_string(count) + " intervals"; }

std::string lengths_text(const std::vector<double>& lengths) {
  std::string text;
  for (double l : lengths) text += (text.empty() ? "" : ", ") + number(l, l < 10 ? "%.2f" : "%.0f");
  return text + " m";
}

void add_absolute(const TrajectoryEvaluation& e, std::vector<Row>* rows) {
  const std::string blocks = std::to_string(e.block_frames);
  rows->push_back({"ATE RMSE", number(e.ate_sim3.rmse), "m", poses(e.ate_sim3.poses),
                   "Sim(3), Umeyama; scale x " + number(e.ate_sim3.scale, "%.6g")});
  rows->push_back({"ATE median", number(e.ate_sim3.median), "m", poses(e.ate_sim3.poses), "same"});
  rows->push_back({"ATE max", number(e.ate_sim3.max), "m", poses(e.ate_sim3.poses), "same"});
  rows->push_back({"ATE RMSE", number(e.ate_se3.rmse), "m", poses(e.ate_se3.poses),
                   "SE(3), Umeyama; meaningful only if the estimate is in metres"});
  rows->push_back({"ATE" + blocks + " RMSE", number(e.ate_blocks.rmse), "m", poses(e.ate_blocks.poses),
                   "scale re-corrected every " + blocks + " input frames, then SE(3)"});
}

void add_relative(const TrajectoryEvaluation& e, std::vector<Row>* rows) {
  const std::string blocks = "scale re-corrected every " + std::to_string(e.block_frames) + " input frames";
  if (e.drift)
    rows->push_back({"drift", number(e.drift->mean_cm_per_m, "%.2f"), "cm/m", intervals(e.drift->intervals),
                     blocks + "; intervals of " + lengths_text(e.drift->lengths_m) + "; " +
                         std::to_string(e.drift->capped) + " capped, " +
                         std::to_string(e.drift->without_poses) + " without poses"});
  else
    rows->push_back({"drift", "-", "cm/m", intervals(0), "the ground truth does not move"});
  const std::string kitti = "one Sim(3) scale; intervals of 100 to 800 m";
  const int n = e.kitti ? e.kitti->intervals : 0;
  rows->push_back(
      {"t_rel", e.kitti ? number(e.kitti->t_rel_percent, "%.3f") : "-", "%", intervals(n), kitti});
  rows->push_back({"r_rel", e.kitti ? number(e.kitti->r_rel_deg_per_100m, "%.3f") : "-", "deg/100m",
                   intervals(n), kitti});
}

void add_scale(const TrajectoryEvaluation& e, std::vector<Row>* rows) {
  if (e.scale_curve.empty()) return;
  const double first = e.scale_curve.front().relative_scale, last = e.scale_curve.back().relative_scale;
  const std::string over = std::to_string(e.scale_curve.size()) + " windows";
  rows->push_back({"local scale, first", number(first), "x", over,
                   "estimate / ground truth in windows of " + std::to_string(e.scale_window_frames) +
                       " input frames, relative to the whole run"});
  rows->push_back({"local scale, last", number(last), "x", over, "same"});
  rows->push_back({"scale drift, last / first", number(last / first), "x", over, "same"});
}

void add_coverage(const Coverage& c, std::vector<Row>* rows) {
  const std::string over = std::to_string(c.input_frames) + " frames";
  rows->push_back({"completion", number(c.completion_percent, "%.1f"), "%", over,
                   std::to_string(c.with_pose) + " have a pose; the first is number " +
                       std::to_string(c.before_first_pose)});
  rows->push_back({"failure rate", number(c.failure_percent, "%.1f"), "%", over,
                   std::to_string(c.lost) + " without a pose after the first that has one"});
}

std::string padded(const std::string& text, size_t width, bool right = false) {
  const std::string blanks(text.size() < width ? width - text.size() : 0, ' ');
  return right ? blanks + text : text + blanks;
}

std::string layout(const std::vector<Row>& rows) {
  size_t metric = 0, value = 0, unit = 0, over = 0;
  for (const Row& r : rows) {
    metric = std::max(metric, r.metric.size());
    value = std::max(value, r.value.size());
    unit = std::max(unit, r.unit.size());
    over = std::max(over, r.over.size());
  }
  std::string text;
  for (const Row& r : rows)
    text += padded(r.metric, metric) + "  " + padded(r.value, value, true) + "  " + padded(r.unit, unit) +
            "  " + padded(r.over, over) + "  " + r.alignment + "\n";
  return text;
}

std::string describe(const TrajectoryFacts& t) {
  return t.path + " (" + t.format + ", " + poses(t.poses) + ")";
}

}  // namespace

std::string to_table(const TrajectoryEvaluation& e) {
  std::ostringstream head;
  head << "trajectory    " << describe(e.estimate) << "\n";
  head << "ground truth  " << describe(e.ground_truth) << ", interpolated to the trajectory's times";
  if (e.drift) head << "; path " << number(e.drift->path_m, "%.1f") << " m";
  head << "\nmatched       " << poses(e.matched) << "; " << e.without_ground_truth
       << " without ground truth\n";
  head << "input         " << e.coverage.input_frames << " frames (" << e.coverage.source << ")\n\n";
  std::vector<Row> rows{{"metric", "value", "unit", "over", "alignment or scale"}};
  add_absolute(e, &rows);
  add_relative(e, &rows);
  add_scale(e, &rows);
  add_coverage(e.coverage, &rows);
  return head.str() + layout(rows);
}

}  // namespace edgevo
