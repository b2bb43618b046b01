#pragma once
// What charts and plans share: ranges of values, axes with ticks, the SVG of lines, labels beside it.
//
// In a page a drawing is an <svg> that is stretched to the width there is, and its labels are HTML over it,
// placed by percent, so that they keep their size on a telephone and on paper.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace edgevo {

constexpr double kWidth = 1000;  // units of a drawing

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  /// Takes `v` in, if it is finite.
  void add(double v);
  bool empty() const { return !(low <= high); }
  double span() const { return high - low; }
  /// Room around the values; never of zero width.
  void widen(double share);
};

/// Maps values to coordinates of the drawing.
struct Axis {
  Range range;
  double at_low, at_high;
  double operator()(double v) const { return at_low + (v - range.low) / range.span() * (at_high - at_low); }
};

/// Steps of 1, 2 or 5 times a power of ten that lie in [low, high], about `count` of them. Empty unless low <
/// high.
std::vector<double> nice_ticks(double low, double high, int count);
/// From one tick to the next; 1 where there is no other.
double step_of(const std::vector<double>& ticks);

/// A coordinate, to a tenth.
std::string svg_number(double v);
/// With as many decimals as ticks `step` apart need.
std::string tick_label(double v, double step);
std::string grid_line(double x0, double y0, double x1, double y1);
/// `stretched`: takes whatever width and height it is given.
std::string svg_open(double height, const std::string& kind, bool stretched);
/// A label of the x axis `share` of the way to the right, or of the y axis `share` of the way down. Those of
/// the x axis with odd `number` give way in narrow windows.
std::string x_label(double share, const std::string& text, int number);
std::string y_label(double share, const std::string& text);
/// Names and colours beside each other.
std::string legend(const std::vector<std::pair<std::string, std::string>>& name_and_color);

/// [1,2.5,null]: six significant digits, null for what is not finite.
std::string json_list(const std::vector<double>& values);
/// A text in its quotes.
std::string json_text(const std::string& text);

}  // namespace edgevo
