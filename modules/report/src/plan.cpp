#include "edgevo/report/plan.h"

#include <algorithm>
#include <cmath>

#include "axes.h"
#include "edgevo/report/page.h"

namespace edgevo {
namespace {

struct PlanAxes {
  Axis left, forward;  // both with `left` growing to the left and `forward` upwards
  double height;
};

// One scale for both directions; the height follows from the run, within limits.
PlanAxes plan_axes(const Plan& plan) {
  Range left, forward;
  for (const PlanLine& line : plan.lines)
    for (const auto& piece : line.pieces)
      for (const auto& [f, l] : piece) forward.add(f), left.add(l);
  if (left.empty()) left.add(0), forward.add(0);
  const double margin = 0.06 * std::max({left.span(), forward.span(), 1e-3});
  left.low -= margin, left.high += margin, forward.low -= margin, forward.high += margin;
  const double width = kWidth - kLeft - kRight;
  double scale = width / left.span();
  const double height = std::clamp(forward.span() * scale, 260.0, 620.0);
  scale = std::min(scale, height / forward.span());
  const auto centred = [](Range r, double span) {
    const double middle = 0.5 * (r.low + r.high);
    return Range{middle - 0.5 * span, middle + 0.5 * span};
  };
  return {{centred(left, width / scale), kWidth - kRight, kLeft},
          {centred(forward, height / scale), kTop + height, kTop},
          kTop + height + kBottom};
}

std::string plan_grid(const PlanAxes& axes, const std::string& unit) {
  std::string svg;
  const double bottom = axes.height - kBottom;
  const auto ticks = nice_ticks(axes.left.range.low, axes.left.range.high, 8);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
  for (double t : ticks) {
    svg += grid_line(axes.left(t), kTop, axes.left(t), bottom);
    svg += text_at(axes.left(t), bottom + 18, "middle", tick_label(t, step));
  }
  for (double t = std::ceil(axes.forward.range.low / step) * step; t <= axes.forward.range.high; t += step) {
    svg += grid_line(kLeft, axes.forward(t), kWidth - kRight, axes.forward(t));
    svg += text_at(kLeft - 6, axes.forward(t) + 4, "end", tick_label(std::round(t / step) * step, step));
  }
  return svg + "<text class=\"name\" transform=\"translate(13 " + svg_number(0.5 * bottom) +
         ") rotate(-90)\" text-anchor=\"middle\">" + html_escaped("forward, " + unit) + "</text>\n" +
         text_at(kWidth - kRight, bottom - 6, "end", "left, " + unit);
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
  return "<path class=\"line\" stroke=\"" + line.color + (line.dashed ? "\" stroke-dasharray=\"7 5" : "") +
         "\" d=\"" + d + "\"/>\n";
}

}  // namespace

std::string draw(const Plan& plan) {
  const PlanAxes axes = plan_axes(plan);
  std::vector<std::pair<std::string, std::string>> entries;
  for (const PlanLine& line : plan.lines) entries.emplace_back(line.name, line.color);
  if (!plan.points.empty()) entries.emplace_back("edge points", "#b9bfca");
  std::string svg =
      legend(entries) + svg_open(axes.height, "plan") + plan_grid(axes, plan.unit) + plan_points(plan, axes);
  for (const PlanLine& line : plan.lines) svg += plan_line(line, axes);
  return svg + "</svg>\n";
}

}  // namespace edgevo
