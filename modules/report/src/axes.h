// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Common parts of charts and plans: ranges of values, axes with ticks, SVG lines, labels.
//
// In a page a drawing is an <svg> stretched to the available width. Its labels are HTML on top of it, placed
// by percent, so that they keep their size on a phone and on paper.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace edgevo {

/// Width of a drawing, in its own units.
constexpr double kWidth = 1000;

/// A range of values, empty at first.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  /// Extends the range to `v`, if that is finite.
  void add(double v);
  bool empty() const { return !(low <= high); }
  double span() const { return high - low; }
  /// Adds a margin of `share` of the span at both ends; the range is never of zero width then.
  void widen(double share);
};

/// Maps values to coordinates of the drawing.
struct Axis {
  Range range;
  double at_low, at_high;
  double operator()(double v) const { return at_low + (v - range.low) / range.span() * (at_high - at_low); }
};

/// About `count` multiples of 1, 2 or 5 times a power of ten in [low, high]. Empty unless low < high.
std::vector<double> nice_ticks(double low, double high, int count);
/// Distance between ticks; 1 if there are fewer than two.
double step_of(const std::vector<double>& ticks);

/// A coordinate as text, with one decimal.
std::string svg_number(double v);
/// A value as text, with as many decimals as ticks `step` apart need.
std::string tick_label(double v, double step);
/// A line of the background grid.
std::string grid_line(double x0, double y0, double x1, double y1);
/// The opening tag of a drawing of class `kind`. `stretched`: it is scaled to any width and height.
std::string svg_open(double height, const std::string& kind, bool stretched);
/// A label of the x axis, `share` (0 to 1) of the width from the left. Labels with an odd `number` are hidden
/// in narrow windows.
std::string x_label(double share, const std::string& text, int number);
/// A label of the y axis, `share` (0 to 1) of the height from the top.
std::string y_label(double share, const std::string& text);
/// A legend in one row.
std::string legend(const std::vector<std::pair<std::string, std::string>>& name_and_color);

/// A JSON list such as [1,2.5,null]: six significant digits, null for values that are not finite.
std::string json_list(const std::vector<double>& values);
/// A JSON string in quotes.
std::string json_text(const std::string& text);

}  // namespace edgevo
