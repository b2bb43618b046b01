// SPDX-License-Identifier: BSD-3-Clause
#include "chain_gaps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace edgevo {
namespace {

// Limits between two vertices of known depth: a longer or steeper gap may be more than one edge.
constexpr double kMaxBridgePx = 200, kMaxBridgeRatio = 1.5;
constexpr double kStraightPx = 1;       // across the chord: an edge is found to half a pixel
constexpr double kShownBetween = 0.7;   // share of the nodes between copied ends
constexpr int kCornerPx = 4;            // from edge to edge: the detector cuts at junctions
constexpr float kCornerCosine = 0.85f;  // between normals: 32 degrees, else the two are one edge, or parallel
constexpr double kCornerSigmas = 3;     // between a copied depth and the node's own

Eigen::Vector2d position(const ImageEdges& edges, const FinalNode& s) {
  return edges.pixels[size_t(s.node.edge_pixel)].position().cast<double>();
}

// Whether the node's own depth, however uncertain, differs.
bool contradicts(const EdgeNode& own, double idepth, double sigma) {
  return own.idepth > 0 &&
         std::abs(own.idepth - idepth) > kCornerSigmas * std::hypot(own.idepth_sigma, sigma);
}

// The gap from one certain node to the next.
class Bridge {
 public:
  Bridge(const ImageEdges& edges, const FinalChain& chain, size_t from, size_t to)
      : edges_(edges),
        chain_(chain),
        from_(from),
        to_(to),
        p_(chain[from].node),
        q_(chain[to].node),
        start_(position(edges, chain[from])),
        chord_(position(edges, chain[to]) - start_) {}

  bool is_straight() const {
    const double length = chord_.norm();
    if (!(length > 0) || length > kMaxBridgePx) return false;
    if (std::max(p_.idepth, q_.idepth) > kMaxBridgeRatio * std::min(p_.idepth, q_.idepth)) return false;
    for (size_t i = from_; i < to_; ++i) {
      const Eigen::Vector2d d = position(edges_, chain_[i]) - start_;
      const double across = std::abs(chord_.x() * d.y() - chord_.y() * d.x());
      if (chain_[i].breaks || across > kStraightPx * length) return false;
    }
    return true;
  }

  bool is_shown(const IsShown& is_shown) const {
    size_t shown = 0;
    for (size_t i = from_ + 1; i < to_; ++i)
      shown += !contradicts(chain_[i].node, idepth_at(i), sigma_at(i)) && is_shown(chain_[i], idepth_at(i));
    return double(shown) >= kShownBetween * double(to_ - from_ - 1);
  }

  EdgeNode node_at(size_t i) const {
    return {chain_[i].node.edge_pixel, idepth_at(i), sigma_at(i), std::min(p_.views, q_.views),
            p_.is_outline && q_.is_outline};
  }

 private:
  double share_at(size_t i) const {
    return chord_.dot(position(edges_, chain_[i]) - start_) / chord_.squaredNorm();
  }
  double idepth_at(size_t i) const { return p_.idepth + share_at(i) * (q_.idepth - p_.idepth); }
  // As if both ends had the same error: at most so much.
  double sigma_at(size_t i) const {
    const double share = std::clamp(share_at(i), 0.0, 1.0);  // a chain may step back along the chord
    return p_.idepth_sigma + share * (q_.idepth_sigma - p_.idepth_sigma);
  }

  const ImageEdges& edges_;
  const FinalChain& chain_;
  const size_t from_, to_;
  const EdgeNode p_, q_;
  const Eigen::Vector2d start_, chord_;
};

// The nodes of all chains whose depth may be copied, in image cells as wide as the largest corner gap.
class CornerGrid {
 public:
  CornerGrid(const ImageEdges& edges, double max_relative_sigma, const std::vector<FinalChain>& chains)
      : edges_(edges), columns_(edges.width / kCornerPx + 1) {
    cells_.resize(size_t(columns_) * size_t(edges.height / kCornerPx + 1));
    for (const FinalChain& chain : chains)
      for (const FinalNode& s : chain)
        if (s.is_known() && s.node.idepth_sigma <= max_relative_sigma * s.node.idepth)
          cells_[cell_of(pixel_of(s.node))].push_back(s.node);
  }

  // The nearest node of another edge that this one meets; null if none is near.
  const EdgeNode* find(const EdgeNode& node) const {
    const EdgePixel& e = pixel_of(node);
    const EdgeNode* best = nullptr;
    float least = kCornerPx;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int cell = int(cell_of(e)) + dy * columns_ + dx;
        if (cell < 0 || cell >= int(cells_.size())) continue;
        for (const EdgeNode& other : cells_[size_t(cell)]) {
          const EdgePixel& o = pixel_of(other);
          const float distance = (o.position() - e.position()).norm();
          if (o.chain == e.chain || distance >= least) continue;
          if (std::abs(o.normal().dot(e.normal())) <= kCornerCosine) least = distance, best = &other;
        }
      }
    return best;
  }

 private:
  const EdgePixel& pixel_of(const EdgeNode& node) const { return edges_.pixels[size_t(node.edge_pixel)]; }
  size_t cell_of(const EdgePixel& e) const {
    return size_t(int(e.y) / kCornerPx * columns_ + int(e.x) / kCornerPx);
  }

  const ImageEdges& edges_;
  int columns_;
  std::vector<std::vector<EdgeNode>> cells_;  // row by row
};

}  // namespace

void bridge_gaps(const ImageEdges& edges, const IsShown& is_shown, FinalChain* chain) {
  size_t last = chain->size();
  for (size_t i = 0; i < chain->size(); ++i) {
    if ((*chain)[i].certain == Certain::kNot) continue;
    const size_t from = std::exchange(last, i);
    if (from >= i || i - from < 2) continue;
    const Bridge bridge(edges, *chain, from, i);
    const bool is_copied = !(*chain)[from].is_known() || !(*chain)[i].is_known();
    if (!bridge.is_straight() || (is_copied && !bridge.is_shown(is_shown))) continue;
    for (size_t k = from + 1; k < i; ++k) (*chain)[k].node = bridge.node_at(k);
    for (size_t k = from; k <= i; ++k) (*chain)[k].certain = Certain::kBetweenEnds;
  }
}

void copy_depth_at_corners(const ImageEdges& edges, double max_relative_sigma,
                           std::vector<FinalChain>* chains) {
  const CornerGrid grid(edges, max_relative_sigma, *chains);
  for (FinalChain& chain : *chains)
    for (FinalNode& s : chain) {
      if (s.is_known() || !(s.node.idepth > 0)) continue;
      const EdgeNode* source = grid.find(s.node);
      if (!source || contradicts(s.node, source->idepth, source->idepth_sigma)) continue;
      const int edge_pixel = s.node.edge_pixel;
      s.node = *source, s.node.edge_pixel = edge_pixel;
      s.certain = Certain::kAtCorner;
    }
}

}  // namespace edgevo
