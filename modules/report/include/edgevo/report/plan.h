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

}  // namespace edgevo
