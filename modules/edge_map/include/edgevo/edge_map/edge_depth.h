// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Depth for the edge pixels of one keyframe, chain by chain, from other images with known poses.
//
// Not from the paper, whose map holds only the points used for tracking. Three steps along an edge:
//   1. Hypotheses: where the epipolar line of a pixel crosses edges of like direction in one or two images,
//      and the depths of its neighbour on the chain.
//   2. Evidence: each hypothesis is projected into all images. The nearest edge there gives one equation,
//          r = n . (e - p(rho)),   J = n . dp/drho,
//      and rho is moved by sum(J r) / sum(J^2), Gauss-Newton in one dimension; its information is
//      sum(J^2) / sigma^2. A view without a matching edge counts against it.
//   3. The chain: dynamic programming selects a hypothesis or none for each pixel, so that depth is
//      continuous along the edge or breaks; then a line fitted to the neighbours smooths it (the image of a
//      straight edge has inverse depths that are exactly linear along it).
// An edge along its epipolar line has J = 0: it takes the depth of its neighbours, of its ends, or of the
// plane that it lies on, or none.
//
// Cost at 1241x376, 20 000 edge pixels, 8 views: about 40 ms (tests/bench/bench_edge_map.cpp). Thread-safe.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edge_map/edge_trace.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

class EdgePlane;

/// Gray values on both sides of an edge pixel.
struct EdgeSides {
  /// Gray value on the darker and on the brighter side.
  uint8_t dark = 0, bright = 0;
};
/// Samples the sides of all edge pixels of an image, in their order. Cost: 0.3 ms for 26 000.
std::vector<EdgeSides> sample_sides(const PyramidLevel& level);

/// Another image of the scene with a known pose.
struct EdgeView {
  /// Pyramid of the image; not null.
  std::shared_ptr<const FramePyramid> pyramid;
  /// Sides of the edge pixels on the finest level; not null.
  std::shared_ptr<const std::vector<EdgeSides>> sides;
  /// Pose, host to this view, unit of the map.
  SE3 T_view_host;
  /// Brightness of the view over that of the host.
  double gain = 1;
  /// Whether its pose is that of tracking, which nothing has adjusted since.
  bool is_tracked = false;
  /// Whether it is a frame between the host and the next keyframe.
  bool is_after_host = false;
};

/// Edge pixel with its depth.
struct EdgeNode {
  /// Index into ImageEdges::pixels of the host.
  int edge_pixel = -1;
  /// Inverse depth 1/z in the host frame.
  double idepth = 0;
  /// Standard deviation of the inverse depth.
  double idepth_sigma = 0;
  /// Number of views that show the edge at that depth.
  int views = 0;
  /// Whether only one side of the edge looks the same in the other views (an occluding contour).
  bool is_outline = false;
  /// Whether it has the depth of a plane of the view (a road, a facade).
  bool is_on_plane = false;
  /// Whether that plane has the depth that the views show.
  bool is_backed_by_plane = false;
};

/// Neighbours on one edge without a jump in depth, in the order of the chain.
using EdgePiece = std::vector<EdgeNode>;

/// Finds the pieces of the host's edges whose depth the views constrain, in the order of its chains. `sides`
/// belongs to the edge pixels of the host, `views` are sorted nearest first, and no depth is below 1 over
/// `max_idepth`. `planes`, unless null: those of the keyframe before as seen from this one, and those of
/// this one afterwards. `trace`, unless null, receives one entry per edge pixel. `known`, unless empty:
/// inverse depths by edge pixel, 0 for none, that need no search where the views show them.
std::vector<EdgePiece> find_edge_depths(const Pinhole& pinhole, const FramePyramid& host,
                                        const std::vector<EdgeSides>& sides,
                                        const std::vector<EdgeView>& views, double max_idepth,
                                        const EdgeMapParams& params, std::vector<EdgePlane>* planes = nullptr,
                                        std::vector<TracedPixel>* trace = nullptr,
                                        const std::vector<double>& known = {});

}  // namespace edgevo
