// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Evidence of the other images for one inverse depth of one edge pixel.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sight_line.h"

namespace edgevo {

/// Edges closer to the image border may be cut off, pixels.
constexpr double kEdgeBorderPx = 3;
/// Position noise of an edge along its normal, pixels.
constexpr double kEdgeSigmaPx = 0.4;
/// Depth in a view over that in the host: from farther off an edge is not seen, or runs together with its
/// neighbours, so that a view which does not show it says nothing.
constexpr double kMaxDepthRatio = 1.6;

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
  /// From here to the pixel of the edge that is looked at next, and their distance along it: what is read for
  /// that one is prefetched.
  Eigen::Vector2f to_next = Eigen::Vector2f::Zero();
  int step = 0;
  EdgeSides sides;
  /// Sight lines in the groups of views.
  std::vector<SightGroup> lines;
};

/// Accuracy of an inverse depth before it is refined.
enum class Guess {
  /// From a crossing in one image.
  kRough,
  /// From the neighbour on the edge.
  kCarriedAlong,
  /// From elsewhere: it is not refined.
  kExact
};

/// Fits `idepth` to the nearest edges in all views and collects their evidence. Stops early if too few views
/// show an edge (then views < params.min_views).
Hypothesis weigh(const EdgeSight& sight, const ViewSet& set, double idepth, Guess guess, double max_idepth,
                 const EdgeMapParams& params);

/// Logarithm of the likelihood of what the views show if the edge has this inverse depth, over that if it
/// lies elsewhere along its ray: half as far, twice, or at its `own` inverse depth, unless that is 0. Views
/// in which depth does not move the point show the same for each, and so say nothing.
double log_likelihood_ratio(const EdgeSight& sight, const ViewSet& set, double idepth, double own,
                            double max_idepth, const EdgeMapParams& params);

/// Logarithm of the odds that an edge lies where it is said to, by the number of images that show one there
/// and of those that do not, against what chance would show.
double log_odds_of_edge(double shown, double not_shown);

/// Whether an edge of another image may be that of the host, whose normal (dark to bright) is expected to
/// look like this there: the host's, turned by ViewGeometry::turn.
inline bool is_like_direction(double normal_x, double normal_y, const EdgePixel& e) {
  constexpr double kMinCosine = 0.75;  // 41 degrees: edges rotate in the image as the camera passes them
  return normal_x * double(e.nx) + normal_y * double(e.ny) >= kMinCosine;
}
inline bool is_like_direction(const ViewGeometry& view, const Eigen::Vector2d& normal_host,
                              const EdgePixel& e) {
  const Eigen::Vector2d expected = view.turn * normal_host;
  return is_like_direction(expected.x(), expected.y(), e);
}

/// Sides of an edge pixel that look different from those of the host.
struct SideChange {
  bool dark = false, bright = false;
};
/// Compares the sides of edge pixel `e` of the view with those of the host.
inline SideChange compare_sides(const EdgeSides& host, const ViewGeometry& view, size_t e) {
  constexpr float kGrayTolerance = 12;  // gray levels: noise, and texture next to the edge
  constexpr float kGrayShare = 0.4f;    // of the step: a side differs when it is off by more
  const EdgeSides& there = (*view.sides)[e];
  const float tolerance = kGrayTolerance + kGrayShare * float(host.bright - host.dark);
  const float share = view.inverse_gain;
  return {std::abs(float(there.dark) * share - float(host.dark)) > tolerance,
          std::abs(float(there.bright) * share - float(host.bright)) > tolerance};
}

}  // namespace edgevo
