#pragma once
// Drawings of report.html as inline SVG: pure functions, the same bytes every time, no script and nothing to
// load.
#include <string>
#include <vector>

namespace edgevo {

/// Text as it may stand in HTML, in attributes too.
std::string html_escaped(const std::string& text);

/// One line of a chart; a y that is not finite is a gap.
struct Series {
  std::string name, color;
  std::vector<double> y;  ///< one for each x of the chart
};

/// Values over time, 1000 units wide. Long series are drawn as the mean of stretches of equal length.
struct TimeChart {
  std::string y_name;     ///< with its unit
  std::vector<double> x;  ///< seconds, ascending
  std::vector<Series> series;
  bool stacked = false;    ///< areas on top of each other; values >= 0
  bool from_zero = false;  ///< the y axis holds 0
  double y_max = 0;        ///< > 0: what is larger leaves the drawing
};
std::string draw(const TimeChart& chart);

/// A strip with one colour for each stretch of equal value; drawn above charts of the same `x`.
struct Ribbon {
  std::vector<double> x;           ///< seconds, ascending
  std::vector<std::string> color;  ///< one for each x
};
std::string draw(const Ribbon& ribbon);

/// A line on the ground; gaps between its pieces.
struct PlanLine {
  std::string name, color;
  bool dashed = false;
  std::vector<std::vector<std::pair<double, double>>> pieces;  ///< (forward, left) points
};
/// Seen from above: forward is up, left is left, one scale for both axes.
struct Plan {
  std::string unit;
  std::vector<std::pair<double, double>> points;  ///< small gray dots below the lines
  std::vector<PlanLine> lines;
};
std::string draw(const Plan& plan);

/// Steps of 1, 2 or 5 times a power of ten that lie in [low, high], about `count` of them. Empty unless low <
/// high.
std::vector<double> nice_ticks(double low, double high, int count);

}  // namespace edgevo
