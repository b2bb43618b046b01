#pragma once
// What the other images say about one inverse depth of one edge pixel.
#include <Eigen/Core>
#include <vector>

#include "sight_line.h"

namespace edgevo {

/// Edges nearer to the image's border may be cut off; pixels.
constexpr double kEdgeBorderPx = 3;
/// Position noise of an edge along its normal, pixels.
constexpr double kEdgeSigmaPx = 0.4;

/// An inverse depth with what speaks for it.
struct Hypothesis {
  double idepth = 0;
  double information = 0;  ///< inverse variance of idepth
  double cost = 0;         ///< in views: each one in whose image the point lies adds 0 (fits) to 1 (does not)
  int in_view = 0;         ///< images in which the point lies
  int views = 0;           ///< of them, those that show the edge there
  int informative = 0;  ///< of these, those in whose image a change of depth moves the point across the edge
  int dark_differs = 0, bright_differs = 0;  ///< of `views`: the side of the edge looks another

  bool is_outline() const {
    return 2 * std::max(dark_differs, bright_differs) > views &&
           4 * std::min(dark_differs, bright_differs) < views;
  }
};

/// One edge pixel of the host and its sight lines.
struct EdgeSight {
  Eigen::Vector2d px, normal;
  EdgeSides sides;
  std::vector<SightLine> lines;  ///< of each view
};

/// How good an inverse depth is before it is weighed.
enum class Guess { kRough, kCarriedAlong };  ///< a crossing in one image; that of the neighbour on the edge

/// Adjusts `idepth` to the nearest edges in all views and weighs what they say; gives up early where too few
/// show any (views < params.min_views then).
Hypothesis weigh(const EdgeSight& sight, const std::vector<ViewGeometry>& views, double idepth, Guess guess,
                 double max_idepth, const EdgeMapParams& params);

/// Whether an edge of another image may be that of the host by its direction, dark to bright.
inline bool is_like_direction(const ViewGeometry& view, const Eigen::Vector2d& normal_host,
                              const EdgePixel& e) {
  constexpr double kMinCosine = 0.75;  // 41 degrees: edges turn in the image as one passes them
  const Eigen::Vector2d expected = view.turn * normal_host;
  return expected.x() * double(e.nx) + expected.y() * double(e.ny) >= kMinCosine;
}

/// Which sides of edge pixel `e` of the view look another than those of the host.
struct SideChange {
  bool dark = false, bright = false;
};
SideChange compare_sides(const EdgeSides& host, const ViewGeometry& view, size_t e);

}  // namespace edgevo
