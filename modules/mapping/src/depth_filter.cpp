// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/depth_filter.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

// Combined standard deviations beyond which a measurement is an outlier.
constexpr double kAgreeSigmas = 3;
// Excess of outliers over agreements beyond which a point is given up: two may be an occlusion.
constexpr int kMoreBad = 2;
constexpr double kSearchSigmas = 2;  // standard deviations to each side: 95 of 100 points lie within
// Least share of an inverse depth that a search goes down to: it stays in front of the camera.
constexpr double kNearestToNone = 1e-3;
// Largest distance between neighbours across the edge: beyond, it is another edge, or a corner.
constexpr double kAcrossPx = 2;
constexpr double kNeighbourPx = 14;  // neighbours further along the edge do not count
// Combined standard deviations beyond which neighbours are at different depths.
constexpr double kNeighbourSigmas = 2;

}  // namespace

void fuse(const EpipolarMatch& m, ImmaturePoint* p) {
  const bool is_uninformative = m.outcome == EpipolarOutcome::kOutOfView ||
                                m.outcome == EpipolarOutcome::kNoBaseline ||
                                m.outcome == EpipolarOutcome::kAlongLine;
  if (is_uninformative) return;
  const double sigma = std::hypot(p->idepth_sigma, m.idepth_sigma);
  if (m.outcome == EpipolarOutcome::kFound && std::abs(m.idepth - p->idepth) < kAgreeSigmas * sigma) {
    if (p->good == 0) {  // the first depth replaces the search range
      p->idepth = m.idepth;
      p->idepth_sigma = m.idepth_sigma;
    } else {
      const double a = p->idepth_sigma * p->idepth_sigma, b = m.idepth_sigma * m.idepth_sigma;
      p->idepth = (p->idepth * b + m.idepth * a) / (a + b);
      p->idepth_sigma = std::sqrt(a * b / (a + b));
    }
    ++p->good;
  } else {
    ++p->bad;
  }
  if (p->bad > kMoreBad + p->good) p->dead = true;
}

void update_depths(const FramePyramid& target, const SE3& T_target_host, const DepthFilterParams& params,
                   Keyframe* host) {
  for (ImmaturePoint& p : host->immature) {
    if (p.dead) continue;
    const double reach = kSearchSigmas * p.idepth_sigma;
    const IdepthRange range{std::max(p.idepth - reach, kNearestToNone * p.idepth), p.idepth + reach};
    fuse(search_epipolar(*host->pyramid, target, p.px, p.normal, T_target_host, range, params), &p);
  }
}

void smooth_along_edges(const ImageEdges& edges, const DepthFilterParams& params,
                        std::vector<ImmaturePoint>* points) {
  if (params.smoothing_weight <= 0) return;
  const auto neighbours = [&](const ImmaturePoint& a, const ImmaturePoint& b) {
    if (a.dead || b.dead || a.good == 0 || b.good == 0) return false;
    if (edges.pixels[a.edge_pixel].chain != edges.pixels[b.edge_pixel].chain) return false;
    const Eigen::Vector2d d = b.px - a.px;
    return d.norm() < kNeighbourPx && std::abs(a.normal.dot(d)) < kAcrossPx &&
           std::abs(a.idepth - b.idepth) < kNeighbourSigmas * std::hypot(a.idepth_sigma, b.idepth_sigma);
  };
  std::vector<double> smoothed(points->size());
  for (size_t i = 0; i < points->size(); ++i) {
    const ImmaturePoint& p = (*points)[i];
    double sum = 0, weight = 0;
    const auto gather = [&](const ImmaturePoint& q) {
      if (!neighbours(p, q)) return;
      const double w = 1.0 / (q.idepth_sigma * q.idepth_sigma);
      sum += w * q.idepth;
      weight += w;
    };
    if (i > 0) gather((*points)[i - 1]);
    if (i + 1 < points->size()) gather((*points)[i + 1]);
    const double w = params.smoothing_weight;
    smoothed[i] = weight > 0 ? (1 - w) * p.idepth + w * sum / weight : p.idepth;
  }
  for (size_t i = 0; i < points->size(); ++i) (*points)[i].idepth = smoothed[i];
}

}  // namespace edgevo
