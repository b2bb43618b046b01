// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Depth of edge points: epipolar searches fused as Gaussians with a count of outliers, and smoothed along the
// edge; new points.
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "edgevo/core/random.h"
#include "edgevo/map/keyframe.h"
#include "edgevo/mapping/cell_grid.h"
#include "edgevo/mapping/epipolar_search.h"
#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

/// New immature points on the edges of `keyframe`: one per cell of `grid`, none in occupied cells, spread by
/// `random`.
/// `range(px)` returns the inverse depths to search.
template <class Range>
std::vector<ImmaturePoint> make_immature_points(const Keyframe& keyframe, const CellGrid& grid,
                                                const std::vector<bool>& occupied_cells, const Range& range,
                                                const DepthFilterParams& params, Random* random);

/// Observes every living immature point of `host` once, in a frame at T_target_host.
void update_depths(const FramePyramid& target, const SE3& T_target_host, const DepthFilterParams& params,
                   Keyframe* host);

/// Fuses a measurement into a point: product of Gaussians if it agrees within 3 sigma, else an outlier. Marks
/// points dead that have more outliers than 2 + agreements.
void fuse(const EpipolarMatch& measurement, ImmaturePoint* point);

/// Pulls inverse depths towards those of agreeing neighbours on the same edge: depth is smooth along an edge
/// except for jumps. A weight of 0 does nothing.
void smooth_along_edges(const ImageEdges& edges, const DepthFilterParams& params,
                        std::vector<ImmaturePoint>* points);

template <class Range>
std::vector<ImmaturePoint> make_immature_points(const Keyframe& keyframe, const CellGrid& grid,
                                                const std::vector<bool>& occupied_cells, const Range& range,
                                                const DepthFilterParams& params, Random* random) {
  const ImageEdges& edges = keyframe.pyramid->finest().edges;
  // Reservoir sampling: each edge pixel of a cell is equally likely to represent it.
  std::vector<int> chosen(grid.size(), -1), seen(grid.size(), 0);
  for (int i = 0; i < int(edges.pixels.size()); ++i) {
    const int c = grid.index(edges.pixels[i].x, edges.pixels[i].y);
    if (!occupied_cells[c] && random->below(++seen[c]) == 0) chosen[c] = i;
  }
  std::vector<int> picked;
  for (int i : chosen)
    if (i >= 0) picked.push_back(i);
  for (size_t k = picked.size(); k > 1; --k) std::swap(picked[k - 1], picked[random->below(int(k))]);
  if (int(picked.size()) > params.max_new_points) picked.resize(params.max_new_points);
  std::sort(picked.begin(), picked.end());

  std::vector<ImmaturePoint> points;
  points.reserve(picked.size());
  for (int i : picked) {
    ImmaturePoint p;
    p.px = edges.pixels[i].position().template cast<double>();
    p.normal = edges.pixels[i].normal().template cast<double>();
    p.edge_pixel = i;
    const IdepthRange r = range(p.px);
    p.idepth = 0.5 * (r.low + r.high);
    p.idepth_sigma = 0.25 * (r.high - r.low);  // the search covers two sigma to each side
    p.idepth_guess = r.guess();
    points.push_back(p);
  }
  return points;
}

}  // namespace edgevo
