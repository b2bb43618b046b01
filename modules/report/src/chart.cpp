#include "edgevo/report/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "axes.h"
#include "edgevo/report/page.h"

namespace edgevo {
namespace {

constexpr double kChartHeight = 190;
constexpr size_t kMaxColumns = 600;  // of a chart: more frames than that are drawn as means

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
    svg += grid_line(kLeft, y(t), kWidth - kRight, y(t));
    svg +=
        text_at(kLeft - 6, y(t) + 4, "end", tick_label(t, y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : 1));
  }
  const auto x_ticks = nice_ticks(x.range.low, x.range.high, 10);
  for (double t : x_ticks) {
    svg += grid_line(x(t), kChartHeight - kBottom, x(t), kChartHeight - kBottom + 4);
    svg += text_at(x(t), kChartHeight - kBottom + 18, "middle",
                   tick_label(t, x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1) + " s");
  }
  return svg + "<text class=\"name\" transform=\"translate(13 " +
         svg_number(0.5 * (kChartHeight - kBottom + kTop)) + ") rotate(-90)\" text-anchor=\"middle\">" +
         html_escaped(y_name) + "</text>\n";
}

std::string path_of(const std::vector<double>& xs, const std::vector<double>& ys, const Axis& x,
                    const Axis& y) {
  std::string d;
  bool drawing = false;
  for (size_t i = 0; i < xs.size(); ++i) {
    const bool there = std::isfinite(ys[i]);
    if (there) d += (drawing ? "L" : "M") + svg_number(x(xs[i])) + ' ' + svg_number(std::max(y(ys[i]), kTop));
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
  const std::string base = svg_number(y(0));
  return "<path class=\"area\" fill=\"" + s.color + "\" d=\"" + path_of(xs, s.y, x, y) + 'L' +
         svg_number(x(xs.back())) + ' ' + base + 'L' + svg_number(x(xs.front())) + ' ' + base + "Z\"/>\n";
}

std::string legend_of(const TimeChart& chart) {
  if (chart.series.size() < 2) return "";
  std::vector<std::pair<std::string, std::string>> entries;
  for (const Series& s : chart.series) entries.emplace_back(s.name, s.color);
  return legend(entries);
}

}  // namespace

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
    svg += "<rect x=\"" + svg_number(from) + "\" y=\"2.0\" width=\"" + svg_number(std::max(to - from, 1.0)) +
           "\" height=\"12.0\" fill=\"" + ribbon.color[begin] + "\"/>\n";
    begin = end;
  }
  return svg + "</svg>\n";
}

}  // namespace edgevo
