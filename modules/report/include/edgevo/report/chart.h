#pragma once
// Charts over time: pure functions, the same bytes every time, nothing to load. In a page they are as wide as
// it is, with labels that stay readable, and assets/page.js tells the values under the pointer.
#include <string>
#include <vector>

namespace edgevo {

/// One line of a chart; a y that is not finite is a gap.
struct Series {
  std::string name, color;  ///< any CSS colour; those of palette.h follow light and dark
  std::vector<double> y;    ///< one for each x of the chart
};

/// Values over time. Long series are drawn as the mean of stretches of equal length.
struct TimeChart {
  std::string y_name;     ///< with its unit
  std::vector<double> x;  ///< seconds, ascending
  std::vector<Series> series;  ///< the first is drawn first
  bool stacked = false;    ///< areas on top of each other; values >= 0
  bool from_zero = false;  ///< the y axis holds 0
  double y_max = 0;        ///< > 0: what is larger leaves the drawing
};
/// For a page.
std::string draw(const TimeChart& chart);
/// The drawing alone as one svg element, 1000 x 190 units, for files of their own.
std::string draw_svg(const TimeChart& chart);

/// A strip with one colour for each stretch of equal value; drawn above charts of the same `x`.
struct Ribbon {
  std::vector<double> x;           ///< seconds, ascending
  std::vector<std::string> color;  ///< one for each x
};
std::string draw(const Ribbon& ribbon);  ///< For a page.

}  // namespace edgevo
