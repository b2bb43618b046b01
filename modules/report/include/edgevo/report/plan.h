// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A top view for a page. Pure functions: the same input gives the same bytes, and nothing is loaded.
// assets/page.js shows the ground position under the pointer.
#include <string>
#include <utility>
#include <vector>

namespace edgevo {

/// A line on the ground, with gaps between its pieces.
struct PlanLine {
  /// Name in the legend (empty: not listed), and colour (palette.h).
  std::string name, color;
  /// Whether the line is dashed, not solid.
  bool dashed = false;
  /// Pieces of (forward, left) points.
  std::vector<std::vector<std::pair<double, double>>> pieces;
};
/// A top view: forward is up, left is left, one scale for both axes.
struct Plan {
  /// Unit of all lengths, for the labels.
  std::string unit;
  /// (forward, left) points, drawn as small gray dots below the lines.
  std::vector<std::pair<double, double>> points;
  /// Lines; the first is drawn first, below the others.
  std::vector<PlanLine> lines;
};
/// The top view as HTML for a page.
std::string draw(const Plan& plan);

}  // namespace edgevo
