// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Charts over time. Pure functions: the same input gives the same bytes, and nothing is loaded. In a page a
// chart is as wide as the page, its labels stay readable, and assets/page.js shows the values under the
// pointer.
#include <string>
#include <vector>

namespace edgevo {

/// One curve of a chart; values that are not finite are gaps.
struct Series {
  /// Name in the legend, and any CSS colour; those of palette.h adapt to light and dark.
  std::string name, color;
  /// Values, one for each x of the chart.
  std::vector<double> y;
};

/// Values over time. Long series are drawn as means over intervals of equal length.
struct TimeChart {
  /// Name and unit of the values.
  std::string y_name;
  /// Times, seconds, ascending.
  std::vector<double> x;
  /// Curves; the first is drawn first, below the others.
  std::vector<Series> series;
  /// Whether the curves are stacked areas; needs values >= 0.
  bool stacked = false;
  /// Whether the y axis includes 0.
  bool from_zero = false;
  /// Upper end of the y axis; larger values are cut. 0: no limit.
  double y_max = 0;
};
/// The chart as HTML for a page.
std::string draw(const TimeChart& chart);
/// The chart as a single svg element, 1000 x 190 units, for a separate file.
std::string draw_svg(const TimeChart& chart);

/// A strip of colours over time, drawn above charts with the same `x`.
struct Ribbon {
  /// Times, seconds, ascending.
  std::vector<double> x;
  /// CSS colours, one for each x.
  std::vector<std::string> color;
};
/// The strip as HTML for a page.
std::string draw(const Ribbon& ribbon);

}  // namespace edgevo
