#pragma once
// Depth for the edge pixels of one keyframe, chain by chain, from other images with known poses.
//
// Not from the paper, whose map holds the points that it tracks by. Along an edge three steps:
//   1. Hypotheses: where the epipolar line of a pixel crosses edges of like direction in one or two images,
//      and what its neighbour on the chain found.
//   2. Evidence: each hypothesis is looked up in all images. The nearest edge there gives one equation,
//          r = n . (e - p(rho)),   J = n . dp/drho,
//      and rho is moved by sum(J r) / sum(J^2), Gauss-Newton in one dimension; its information is
//      sum(J^2) / sigma^2. A view without a fitting edge speaks against it.
//   3. The chain: dynamic programming picks a hypothesis or none for each pixel, so that depth goes on along
//      the edge or breaks; a line fitted to the neighbours then smooths (the image of a straight edge has
//      inverse depths that are linear along it, exactly).
// An edge along its epipolar line has J = 0: it gets the depth of its neighbours, or none.
//
// Cost at 1241x376, 20 000 edge pixels, 8 views: some 40 ms (tests/bench/bench_edge_map.cpp). Any thread.
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

/// Gray levels on both sides of an edge pixel.
struct EdgeSides {
  uint8_t dark = 0, bright = 0;  ///< gray levels on the darker and the brighter side
};
/// Of each edge pixel of an image. Cost: 0.3 ms for 26 000.
std::vector<EdgeSides> sample_sides(const PyramidLevel& level);

/// Another image of the scene. Lengths in the unit of the map.
struct EdgeView {
  std::shared_ptr<const FramePyramid> pyramid;          ///< of the image; not null
  std::shared_ptr<const std::vector<EdgeSides>> sides;  ///< of the pyramid's finest level
  SE3 T_view_host;                                      ///< host to this view
  double gain = 1;                                      ///< its brightness over the host's
};

/// A pixel of an edge with its depth.
struct EdgeNode {
  int edge_pixel = -1;      ///< index into the host's EdgeMap
  double idepth = 0;        ///< 1/z in the host frame
  double idepth_sigma = 0;  ///< one standard deviation, same unit
  int views = 0;            ///< that show it there
  bool is_outline = false;  ///< only one side of the edge looks the same from elsewhere
};

/// Neighbours on one edge without a jump in depth, in the order of the chain.
using EdgePiece = std::vector<EdgeNode>;

/// The stretches of the host's edges whose depth the views tell, in the order of its chains. `sides`: of each
/// edge pixel of the host. `views`: the nearest first. Nothing is nearer than 1 over `max_idepth`. `trace`:
/// of each edge pixel, filled if not null.
std::vector<EdgePiece> find_edge_depths(const Pinhole& pinhole, const FramePyramid& host,
                                        const std::vector<EdgeSides>& sides,
                                        const std::vector<EdgeView>& views, double max_idepth,
                                        const EdgeMapParams& params,
                                        std::vector<TracedPixel>* trace = nullptr);

}  // namespace edgevo
