#pragma once
// What charts and plans share: ranges of values, axes with ticks, and the SVG of lines and labels.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace edgevo {

// Units of the drawings: their width, and the room around what is drawn.
constexpr double kWidth = 1000, kLeft = 72, kRight = 10, kTop = 8, kBottom = 28;

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

/// A coordinate, to a tenth.
std::string svg_number(double v);
/// With as many decimals as ticks `step` apart need.
std::string tick_label(double v, double step);
std::string text_at(double x, double y, const std::string& anchor, const std::string& text);
std::string grid_line(double x0, double y0, double x1, double y1);
std::string svg_open(double height, const std::string& kind);
/// Names and colours below each other.
std::string legend(const std::vector<std::pair<std::string, std::string>>& name_and_color);

}  // namespace edgevo
