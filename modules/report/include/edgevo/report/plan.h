#pragma once
// A drawing from above for a page: pure functions, the same bytes every time, nothing to load. assets/page.js
// tells where on the ground the pointer is.
#include <string>
#include <utility>
#include <vector>

namespace edgevo {

/// A line on the ground; gaps between its pieces.
struct PlanLine {
  std::string name, color;  ///< without a name it is not in the legend; colours: palette.h
  bool dashed = false;  ///< else drawn through
  std::vector<std::vector<std::pair<double, double>>> pieces;  ///< (forward, left) points
};
/// Seen from above: forward is up, left is left, one scale for both axes.
struct Plan {
  std::string unit;  ///< of all lengths, for the scale
  std::vector<std::pair<double, double>> points;  ///< small gray dots below the lines
  std::vector<PlanLine> lines;  ///< the first is drawn first
};
std::string draw(const Plan& plan);  ///< For a page.

}  // namespace edgevo
