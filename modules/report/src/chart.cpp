// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "axes.h"
#include "edgevo/report/page.h"

namespace edgevo {
namespace {

constexpr double kPlotHeight = 154;
// Margins around the plot in a drawing with labels inside.
constexpr double kLeft = 72, kRight = 10, kTop = 8, kBottom = 28;
constexpr size_t kMaxColumns = 600;  // more frames than that are drawn as means

// The mean of every `per` values; NaN if none of them is finite.
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

TimeChart thinned_chart(const TimeChart& chart) {
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

// A chart as drawn, with its axes.
struct Plot {
  TimeChart chart;
  Axis x, y;
};

Plot plot_in(const TimeChart& thin, double left, double right, double top, double bottom) {
  Plot plot{thin, {x_range(thin.x), left, right}, {}};
  if (plot.chart.stacked) stack(&plot.chart);
  plot.y = {y_range(plot.chart), bottom, top};
  return plot;
}

std::vector<double> y_ticks(const Plot& plot) { return nice_ticks(plot.y.range.low, plot.y.range.high, 4); }
std::vector<double> x_ticks(const Plot& plot) { return nice_ticks(plot.x.range.low, plot.x.range.high, 10); }

std::string time_grid(const Plot& p) {
  std::string svg;
  for (double t : y_ticks(p)) svg += grid_line(p.x.at_low, p.y(t), p.x.at_high, p.y(t));
  for (double t : x_ticks(p)) svg += grid_line(p.x(t), p.y.at_low, p.x(t), p.y.at_low - 5);
  return svg;
}

std::string html_labels(const Plot& plot) {
  std::string html;
  int number = 0;
  for (double t : y_ticks(plot))
    html += y_label((plot.y.range.high - t) / plot.y.range.span(), tick_label(t, step_of(y_ticks(plot))));
  for (double t : x_ticks(plot))
    html += x_label((t - plot.x.range.low) / plot.x.range.span(),
                    tick_label(t, step_of(x_ticks(plot))) + " s", number++);
  return html;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" text-anchor=\"" + anchor + "\">" +
         html_escaped(text) + "</text>\n";
}

std::string svg_labels(const Plot& p) {
  std::string svg;
  for (double t : y_ticks(p))
    svg += text_at(p.x.at_low - 6, p.y(t) + 4, "end", tick_label(t, step_of(y_ticks(p))));
  for (double t : x_ticks(p))
    svg += text_at(p.x(t), p.y.at_low + 18, "middle", tick_label(t, step_of(x_ticks(p))) + " s");
  return svg + "<text transform=\"translate(13 " + svg_number(0.5 * (p.y.at_low + p.y.at_high)) +
         ") rotate(-90)\" text-anchor=\"middle\">" + html_escaped(p.chart.y_name) + "</text>\n";
}

std::string path_of(const std::vector<double>& xs, const std::vector<double>& ys, const Axis& x,
                    const Axis& y) {
  std::string d;
  bool drawing = false;
  for (size_t i = 0; i < xs.size(); ++i) {
    const bool there = std::isfinite(ys[i]);
    if (there)
      d += (drawing ? "L" : "M") + svg_number(x(xs[i])) + ' ' + svg_number(std::max(y(ys[i]), y.at_high));
    // A single value between two gaps is a dot.
    if (there && !drawing && (i + 1 == xs.size() || !std::isfinite(ys[i + 1]))) d += "h0.1";
    drawing = there;
  }
  return d;
}

std::string line_of(const Series& s, const std::vector<double>& xs, const Axis& x, const Axis& y) {
  return "<path class=\"line\" style=\"stroke:" + s.color + "\" d=\"" + path_of(xs, s.y, x, y) + "\"/>\n";
}

// Area from zero up to the stacked sum. Areas are drawn from the topmost down, so that each covers the lower
// part of the one above.
std::string area_of(const Series& s, const std::vector<double>& xs, const Axis& x, const Axis& y) {
  if (xs.empty()) return "";
  const std::string base = svg_number(y(0));
  return "<path class=\"area\" style=\"fill:" + s.color + "\" d=\"" + path_of(xs, s.y, x, y) + 'L' +
         svg_number(x(xs.back())) + ' ' + base + 'L' + svg_number(x(xs.front())) + ' ' + base + "Z\"/>\n";
}

std::string legend_of(const TimeChart& chart) {
  if (chart.series.size() < 2) return "";
  std::vector<std::pair<std::string, std::string>> entries;
  for (const Series& s : chart.series) entries.emplace_back(s.name, s.color);
  return legend(entries);
}

std::string lines_of(const Plot& p) {
  std::string svg;
  const std::vector<Series>& series = p.chart.series;
  if (p.chart.stacked)
    for (auto s = series.rbegin(); s != series.rend(); ++s) svg += area_of(*s, p.chart.x, p.x, p.y);
  else
    for (const Series& s : series) svg += line_of(s, p.chart.x, p.x, p.y);
  return svg;
}

// "var(--blue,#1f5fbf)" -> "#1f5fbf": programs other than browsers do not know CSS variables.
TimeChart in_plain_colors(TimeChart chart) {
  for (Series& s : chart.series)
    if (const size_t comma = s.color.find(','); s.color.rfind("var(", 0) == 0 && comma != std::string::npos)
      s.color = s.color.substr(comma + 1, s.color.size() - comma - 2);
  return chart;
}

// The values that page.js shows under the pointer.
std::string values_of(const TimeChart& thin) {
  const Range range = x_range(thin.x);
  std::string series;
  for (const Series& s : thin.series)
    series += (series.empty() ? "" : ",") + ("{\"name\":" + json_text(s.name)) +
              ",\"color\":" + json_text(s.color) + ",\"y\":" + json_list(s.y) + "}";
  return "{\"range\":" + json_list({range.low, range.high}) + ",\"x\":" + json_list(thin.x) +
         ",\"series\":[" + series + "]}";
}

}  // namespace

std::string draw(const TimeChart& all) {
  const TimeChart thin = thinned_chart(all);
  const Plot plot = plot_in(thin, 0, kWidth, 0, kPlotHeight);
  return "<div class=\"chart\" tabindex=\"0\" role=\"figure\" aria-label=\"" + html_escaped(all.y_name) +
         " over time; arrow keys read it\" data-chart=\"" + html_escaped(values_of(thin)) +
         "\">\n<p class=\"name\">" + html_escaped(all.y_name) + "</p>\n" + legend_of(all) +
         "<div class=\"plot\">" + svg_open(kPlotHeight, "chart", true) + time_grid(plot) + lines_of(plot) +
         "</svg>\n" + html_labels(plot) + "</div></div>\n";
}

std::string draw_svg(const TimeChart& all) {
  const Plot plot =
      plot_in(thinned_chart(in_plain_colors(all)), kLeft, kWidth - kRight, kTop, kTop + kPlotHeight);
  return svg_open(kTop + kPlotHeight + kBottom, "chart", false) + time_grid(plot) + svg_labels(plot) +
         lines_of(plot) + "</svg>\n";
}

std::string draw(const Ribbon& ribbon) {
  constexpr double kHeight = 16;
  const Axis x{x_range(ribbon.x), 0, kWidth};
  std::string svg = svg_open(kHeight, "ribbon", true);
  for (size_t begin = 0; begin < ribbon.x.size();) {
    size_t end = begin + 1;
    while (end < ribbon.x.size() && ribbon.color[end] == ribbon.color[begin]) ++end;
    const double from = x(ribbon.x[begin]), to = end < ribbon.x.size() ? x(ribbon.x[end]) : kWidth;
    svg += "<rect x=\"" + svg_number(from) + "\" y=\"2.0\" width=\"" + svg_number(std::max(to - from, 1.0)) +
           "\" height=\"12.0\" style=\"fill:" + ribbon.color[begin] + "\"/>\n";
    begin = end;
  }
  return "<div class=\"strip\"><div class=\"plot\">" + svg + "</svg></div></div>\n";
}

}  // namespace edgevo
