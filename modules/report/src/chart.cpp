#include "edgevo/report/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

constexpr double kWidth = 1000, kLeft = 72, kRight = 10, kTop = 8, kBottom = 28, kChartHeight = 190;
constexpr size_t kMaxColumns = 600;  // of a chart: more frames than that are drawn as means

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double v) {
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  }
  bool empty() const { return !(low <= high); }
  double span() const { return high - low; }
  /// Room around the values; never of zero width.
  void widen(double share) {
    const double margin = span() > 0 ? share * span() : std::max(1e-3, 0.05 * std::abs(high));
    low -= margin, high += margin;
  }
};

// Maps values to coordinates of the drawing.
struct Axis {
  Range range;
  double at_low, at_high;
  double operator()(double v) const { return at_low + (v - range.low) / range.span() * (at_high - at_low); }
};

std::string number(double v) { return fixed(v, 1); }

std::string tick_label(double v, double step) {
  const int decimals = std::clamp(int(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  return fixed(v, decimals);
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" +
         html_escaped(text) + "</text>\n";
}

std::string segment(double x0, double y0, double x1, double y1) {
  return "<path class=\"grid\" d=\"M" + number(x0) + ' ' + number(y0) + 'L' + number(x1) + ' ' + number(y1) +
         "\"/>\n";
}

std::string svg_open(double height, const std::string& kind) {
  return "<svg class=\"" + kind + "\" viewBox=\"0 0 " + number(kWidth) + ' ' + number(height) +
         "\" role=\"img\">\n";
}

// The mean of each stretch of `per` values; NaN where none is finite.
std::vector<double> means(const std::vector<double>& values, size_t per) {
  std::vector<double> result;
  for (size_t begin = 0; begin < values.size(); begin += per) {
    double sum = 0;
    int count = 0;
    for (size_t i = begin; i < std::min(begin + per, values.size()); ++i)
      if (std::isfinite(values[i])) sum += values[i], ++count;
    result.push_back(count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

TimeChart thinned(const TimeChart& chart) {
  const size_t per = std::max<size_t>(1, (chart.x.size() + kMaxColumns - 1) / kMaxColumns);
  TimeChart thin = chart;
  thin.x = means(chart.x, per);
  for (Series& s : thin.series) s.y = means(s.y, per);
  return thin;
}

void stack(TimeChart* chart) {
  for (size_t s = 0; s < chart->series.size(); ++s)
    for (size_t i = 0; i < chart->x.size(); ++i) {
      double& y = chart->series[s].y[i];
      y = (std::isfinite(y) ? y : 0) + (s > 0 ? chart->series[s - 1].y[i] : 0);
    }
}

Range y_range(const TimeChart& chart) {
  Range range;
  for (const Series& s : chart.series)
    for (double y : s.y) range.add(y);
  if (range.empty()) range.add(0);
  if (chart.from_zero || chart.stacked) range.add(0);
  const double low = range.low;
  range.widen(0.05);
  if (chart.from_zero || chart.stacked) range.low = std::min(low, 0.0);
  if (chart.y_max > 0) range.high = std::min(range.high, chart.y_max);
  return range;
}

Range x_range(const std::vector<double>& x) {
  Range range;
  for (double v : x) range.add(v);
  if (range.empty()) range.add(0);
  if (!(range.span() > 0)) range.widen(0.5);
  return range;
}

std::string time_axes(const Axis& x, const Axis& y, const std::string& y_name) {
  std::string svg;
  const auto y_ticks = nice_ticks(y.range.low, y.range.high, 4);
  for (double t : y_ticks) {
    svg += segment(kLeft, y(t), kWidth - kRight, y(t));
    svg +=
        text_at(kLeft - 6, y(t) + 4, "end", tick_label(t, y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : 1));
  }
  const auto x_ticks = nice_ticks(x.range.low, x.range.high, 10);
  for (double t : x_ticks) {
    svg += segment(x(t), kChartHeight - kBottom, x(t), kChartHeight - kBottom + 4);
    svg += text_at(x(t), kChartHeight - kBottom + 18, "middle",
                   tick_label(t, x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1) + " s");
  }
  return svg + "<text class=\"name\" transform=\"translate(13 " +
         number(0.5 * (kChartHeight - kBottom + kTop)) + ") rotate(-90)\" text-anchor=\"middle\">" +
         html_escaped(y_name) + "</text>\n";
}

std::string path_of(const std::vector<double>& xs, const std::vector<double>& ys, const Axis& x,
                    const Axis& y) {
  std::string d;
  bool drawing = false;
  for (size_t i = 0; i < xs.size(); ++i) {
    const bool there = std::isfinite(ys[i]);
    if (there) d += (drawing ? "L" : "M") + number(x(xs[i])) + ' ' + number(std::max(y(ys[i]), kTop));
    // A single value between two gaps is a dot.
    if (there && !drawing && (i + 1 == xs.size() || !std::isfinite(ys[i + 1]))) d += "h0.1";
    drawing = there;
  }
  return d;
}

std::string line_of(const Series& s, const std::vector<double>& xs, const Axis& x, const Axis& y) {
  return "<path class=\"line\" stroke=\"" + s.color + "\" d=\"" + path_of(xs, s.y, x, y) + "\"/>\n";
}

// From the sum of the series below up to its own; drawn from the topmost down, each over the one above.
std::string area_of(const Series& s, const std::vector<double>& xs, const Axis& x, const Axis& y) {
  if (xs.empty()) return "";
  const std::string base = number(y(0));
  return "<path class=\"area\" fill=\"" + s.color + "\" d=\"" + path_of(xs, s.y, x, y) + 'L' +
         number(x(xs.back())) + ' ' + base + 'L' + number(x(xs.front())) + ' ' + base + "Z\"/>\n";
}

std::string legend(const std::vector<std::pair<std::string, std::string>>& name_and_color) {
  std::string html = "<p class=\"legend\">";
  for (const auto& [name, color] : name_and_color)
    html += "<span><i style=\"background:" + color + "\"></i>" + html_escaped(name) + "</span> ";
  return html + "</p>\n";
}

std::string legend_of(const TimeChart& chart) {
  if (chart.series.size() < 2) return "";
  std::vector<std::pair<std::string, std::string>> entries;
  for (const Series& s : chart.series) entries.emplace_back(s.name, s.color);
  return legend(entries);
}

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
    svg += segment(axes.left(t), kTop, axes.left(t), bottom);
    svg += text_at(axes.left(t), bottom + 18, "middle", tick_label(t, step));
  }
  for (double t = std::ceil(axes.forward.range.low / step) * step; t <= axes.forward.range.high; t += step) {
    svg += segment(kLeft, axes.forward(t), kWidth - kRight, axes.forward(t));
    svg += text_at(kLeft - 6, axes.forward(t) + 4, "end", tick_label(std::round(t / step) * step, step));
  }
  return svg + "<text class=\"name\" transform=\"translate(13 " + number(0.5 * bottom) +
         ") rotate(-90)\" text-anchor=\"middle\">" + html_escaped("forward, " + unit) + "</text>\n" +
         text_at(kWidth - kRight, bottom - 6, "end", "left, " + unit);
}

std::string plan_points(const Plan& plan, const PlanAxes& axes) {
  std::string d;
  for (const auto& [f, l] : plan.points) {
    if (f < axes.forward.range.low || f > axes.forward.range.high || l < axes.left.range.low ||
        l > axes.left.range.high)
      continue;
    d += 'M' + number(axes.left(l)) + ' ' + number(axes.forward(f)) + "h0";
  }
  return "<path class=\"dots\" d=\"" + d + "\"/>\n";
}

std::string plan_line(const PlanLine& line, const PlanAxes& axes) {
  std::string d;
  for (const auto& piece : line.pieces)
    for (size_t i = 0; i < piece.size(); ++i)
      d += (i == 0 ? "M" : "L") + number(axes.left(piece[i].second)) + ' ' +
           number(axes.forward(piece[i].first));
  return "<path class=\"line\" stroke=\"" + line.color + (line.dashed ? "\" stroke-dasharray=\"7 5" : "") +
         "\" d=\"" + d + "\"/>\n";
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    if (c == '&')
      html += "&amp;";
    else if (c == '<')
      html += "&lt;";
    else if (c == '>')
      html += "&gt;";
    else if (c == '"')
      html += "&quot;";
    else
      html += c;
  }
  return html;
}

std::vector<double> nice_ticks(double low, double high, int count) {
  if (!(low < high) || count < 1) return {};
  const double rough = (high - low) / count, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * 0.999) step = factor * power;
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ticks.push_back(k * step);
  return ticks;
}

std::string draw(const TimeChart& all) {
  TimeChart chart = thinned(all);
  if (chart.stacked) stack(&chart);
  const Axis x{x_range(chart.x), kLeft, kWidth - kRight};
  const Axis y{y_range(chart), kChartHeight - kBottom, kTop};
  std::string svg = legend_of(chart) + svg_open(kChartHeight, "chart") + time_axes(x, y, chart.y_name);
  if (chart.stacked)
    for (auto s = chart.series.rbegin(); s != chart.series.rend(); ++s) svg += area_of(*s, chart.x, x, y);
  else
    for (const Series& s : chart.series) svg += line_of(s, chart.x, x, y);
  return svg + "</svg>\n";
}

std::string draw(const Ribbon& ribbon) {
  constexpr double kHeight = 16;
  const Axis x{x_range(ribbon.x), kLeft, kWidth - kRight};
  std::string svg = svg_open(kHeight, "ribbon");
  for (size_t begin = 0; begin < ribbon.x.size();) {
    size_t end = begin + 1;
    while (end < ribbon.x.size() && ribbon.color[end] == ribbon.color[begin]) ++end;
    const double from = x(ribbon.x[begin]), to = end < ribbon.x.size() ? x(ribbon.x[end]) : kWidth - kRight;
    svg += "<rect x=\"" + number(from) + "\" y=\"2.0\" width=\"" + number(std::max(to - from, 1.0)) +
           "\" height=\"12.0\" fill=\"" + ribbon.color[begin] + "\"/>\n";
    begin = end;
  }
  return svg + "</svg>\n";
}

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
