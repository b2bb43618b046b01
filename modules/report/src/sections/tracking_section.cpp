// SPDX-License-Identifier: BSD-3-Clause
#include "tracking_section.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "edgevo/report/chart.h"
#include "edgevo/report/page.h"
#include "edgevo/report/palette.h"
#include "frame_times.h"

namespace edgevo {
namespace {

constexpr double kNotAligned = std::numeric_limits<double>::quiet_NaN();

std::string color_of(TrackingState state) {
  switch (state) {
    case TrackingState::kTracking:
      return palette::kGreen;
    case TrackingState::kDegraded:
      return palette::kAmber;
    case TrackingState::kLost:
      return palette::kRed;
    case TrackingState::kBootstrapping:
      return palette::kGray;
  }
  return "";
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

// The chart, or nothing if no frame was aligned.
std::string drawn_if_any(const TimeChart& chart) {
  const std::vector<double>& y = chart.series.front().y;
  return std::any_of(y.begin(), y.end(), [](double v) { return std::isfinite(v); }) ? draw(chart) : "";
}

// Table of the reasons for keyframes.
std::string keyframe_reasons(const Run& run) {
  std::map<std::string_view, std::pair<int, int>> count;  // by reason: keyframes, other frames
  for (const FrameRecord& f : run.frames) {
    if (f.keyframe_reason == KeyframeReason::kNone) continue;
    auto& [keyframes, others] = count[to_string(f.keyframe_reason)];
    ++(f.is_keyframe ? keyframes : others);
  }
  if (count.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [reason, n] : count)
    rows.push_back({std::string(reason), std::to_string(n.first), std::to_string(n.second)});
  return table_html({"reason for a keyframe", "keyframes", "postponed, or returned to an older one"}, rows);
}

}  // namespace

std::string tracking_section(const Run& run) {
  Ribbon ribbon{seconds_of(run), {}};
  for (const FrameRecord& f : run.frames) ribbon.color.push_back(color_of(f.state));
  const auto aligned = [](const FrameRecord& f, double value) {
    return f.evidence.inlier_share > 0 ? value : kNotAligned;
  };
  const TimeChart inliers = chart_of(run, "inlier share", palette::kBlue,
                                     [&](const auto& f) { return aligned(f, f.evidence.inlier_share); });
  const TimeChart residual = chart_of(run, "residual, px", palette::kPurple,
                                      [&](const auto& f) { return aligned(f, f.evidence.residual_px); });
  const TimeChart edges =
      chart_of(run, "edge pixels", palette::kSlate, [](const auto& f) { return double(f.evidence.edges); });
  return section_html("states", "Tracking over the run",
                      state_legend(run) + draw(ribbon) + drawn_if_any(inliers) + drawn_if_any(residual) +
                          draw(edges) + keyframe_reasons(run));
}

}  // namespace edgevo
