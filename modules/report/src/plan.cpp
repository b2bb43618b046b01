// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/plan.h"

#include <algorithm>
#include <cmath>

#include "axes.h"
#include "edgevo/report/page.h"

namespace edgevo {
namespace {

struct PlanAxes {
  Axis left, forward;  // `left` grows to the left, `forward` upwards
  double height;
};

// Axes with one scale for both directions; the height follows from the lines, within limits.
PlanAxes plan_axes(const Plan& plan) {
  Range left, forward;
  for (const PlanLine& line : plan.lines)
    for (const auto& piece : line.pieces)
      for (const auto& [f, l] : piece) forward.add(f), left.add(l);
  if (left.empty()) left.add(0), forward.add(0);
  const double margin = 0.06 * std::max({left.span(), forward.span(), 1e-3});
  left.low -= margin, left.high += margin, forward.low -= margin, forward.high += margin;
  double scale = kWidth / left.span();
  const double height = std::clamp(forward.span() * scale, 260.0, 620.0);
  scale = std::min(scale, height / forward.span());
  const auto centred = [](Range r, double span) {
    const double middle = 0.5 * (r.low + r.high);
    return Range{middle - 0.5 * span, middle + 0.5 * span};
  };
  return {{centred(left, kWidth / scale), kWidth, 0}, {centred(forward, height / scale), height, 0}, height};
}

std::vector<double> left_ticks(const PlanAxes& axes) {
  return nice_ticks(axes.left.range.low, axes.left.range.high, 8);
}

// Ticks as far apart as those of the other axis.
std::vector<double> forward_ticks(const PlanAxes& axes) {
  const double step = step_of(left_ticks(axes));
  std::vector<double> ticks;
  for (double k = std::ceil(axes.forward.range.low / step); k * step <= axes.forward.range.high; ++k)
    ticks.push_back(k * step);
  return ticks;
}

std::string plan_grid(const PlanAxes& axes) {
  std::string svg;
  for (double t : left_ticks(axes)) svg += grid_line(axes.left(t), 0, axes.left(t), axes.height);
  for (double t : forward_ticks(axes)) svg += grid_line(0, axes.forward(t), kWidth, axes.forward(t));
  return svg;
}

std::string plan_labels(const PlanAxes& axes) {
  const double step = step_of(left_ticks(axes));
  std::string html;
  int number = 0;
  for (double t : left_ticks(axes)) html += x_label(axes.left(t) / kWidth, tick_label(t, step), number++);
  for (double t : forward_ticks(axes)) html += y_label(axes.forward(t) / axes.height, tick_label(t, step));
  return html;
}

std::string plan_points(const Plan& plan, const PlanAxes& axes) {
  std::string d;
  for (const auto& [f, l] : plan.points) {
    if (f < axes.forward.range.low || f > axes.forward.range.high || l < axes.left.range.low ||
        l > axes.left.range.high)
      continue;
    d += 'M' + svg_number(axes.left(l)) + ' ' + svg_number(axes.forward(f)) + "h0";
  }
  return "<path class=\"dots\" d=\"" + d + "\"/>\n";
}

std::string plan_line(const PlanLine& line, const PlanAxes& axes) {
  std::string d;
  for (const auto& piece : line.pieces)
    for (size_t i = 0; i < piece.size(); ++i)
      d += (i == 0 ? "M" : "L") + svg_number(axes.left(piece[i].second)) + ' ' +
           svg_number(axes.forward(piece[i].first));
  return "<path class=\"line\" style=\"stroke:" + line.color +
         (line.dashed ? "\" stroke-dasharray=\"7 5" : "") + "\" d=\"" + d + "\"/>\n";
}

// Ranges of the axes, from which page.js computes the position under the pointer.
std::string ranges_of(const PlanAxes& axes, const std::string& unit) {
  return "{\"left\":" + json_list({axes.left.range.high, axes.left.range.low}) +
         ",\"forward\":" + json_list({axes.forward.range.high, axes.forward.range.low}) +
         ",\"unit\":" + json_text(unit) + "}";
}

}  // namespace

std::string draw(const Plan& plan) {
  const PlanAxes axes = plan_axes(plan);
  std::vector<std::pair<std::string, std::string>> entries;
  for (const PlanLine& line : plan.lines)
    if (!line.name.empty()) entries.emplace_back(line.name, line.color);
  if (!plan.points.empty()) entries.emplace_back("edge points", "var(--dots,#b9bfca)");
  std::string html = "<div class=\"plan\" role=\"figure\" aria-label=\"from above\" data-plan=\"" +
                     html_escaped(ranges_of(axes, plan.unit)) + "\">\n<p class=\"name\">" +
                     html_escaped("forward up, left to the left, " + plan.unit) + "</p>\n" + legend(entries) +
                     "<div class=\"plot\">" + svg_open(axes.height, "plan", false) + plan_grid(axes) +
                     plan_points(plan, axes);
  for (const PlanLine& line : plan.lines) html += plan_line(line, axes);
  return html + "</svg>\n" + plan_labels(axes) + "</div></div>\n";
}

}  // namespace edgevo
