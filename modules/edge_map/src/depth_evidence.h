// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Evidence of the other images for one inverse depth of one edge pixel.
#include <Eigen/Core>
#include <vector>

#include "sight_line.h"

namespace edgevo {

/// Edges closer to the image border may be cut off, pixels.
constexpr double kEdgeBorderPx = 3;
/// Position noise of an edge along its normal, pixels.
constexpr double kEdgeSigmaPx = 0.4;

/// Inverse depth with the evidence for it.
struct Hypothesis {
  double idepth = 0;
  /// Inverse variance of idepth.
  double information = 0;
  /// Sum over the views that contain the point of 0 (fits) to 1 (does not fit).
  double cost = 0;
  /// Number of views that contain the point.
  int in_view = 0;
  /// Number of views that show the edge there.
  int views = 0;
  /// Number of views that show the edge and in which a change of depth moves the point across it.
  int informative = 0;
  /// Number of views that show the edge with a different dark or bright side.
  int dark_differs = 0, bright_differs = 0;

  /// Whether only one side of the edge looks the same in most views.
  bool is_outline() const {
    return 2 * std::max(dark_differs, bright_differs) > views &&
           4 * std::min(dark_differs, bright_differs) < views;
  }
};

/// Edge pixel of the host with its sight lines.
struct EdgeSight {
  Eigen::Vector2d px, normal;
  EdgeSides sides;
  /// Sight line in each view.
  std::vector<SightLine> lines;
};

/// Accuracy of an inverse depth before it is refined.
enum class Guess {
  /// From a crossing in one image.
  kRough,
  /// From the neighbour on the edge.
  kCarriedAlong
};

/// Fits `idepth` to the nearest edges in all views and collects their evidence. Stops early if too few views
/// show an edge (then views < params.min_views).
Hypothesis weigh(const EdgeSight& sight, const std::vector<ViewGeometry>& views, double idepth, Guess guess,
                 double max_idepth, const EdgeMapParams& params);

/// Whether an edge of another image may be that of the host, given its direction (dark to bright).
inline bool is_like_direction(const ViewGeometry& view, const Eigen::Vector2d& normal_host,
                              const EdgePixel& e) {
  constexpr double kMinCosine = 0.75;  // 41 degrees: edges rotate in the image as the camera passes them
  const Eigen::Vector2d expected = view.turn * normal_host;
  return expected.x() * double(e.nx) + expected.y() * double(e.ny) >= kMinCosine;
}

/// Sides of an edge pixel that look different from those of the host.
struct SideChange {
  bool dark = false, bright = false;
};
/// Compares the sides of edge pixel `e` of the view with those of the host.
SideChange compare_sides(const EdgeSides& host, const ViewGeometry& view, size_t e);

}  // namespace edgevo
