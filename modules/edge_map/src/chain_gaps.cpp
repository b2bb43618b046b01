#include "chain_gaps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace edgevo {
namespace {

// Between two vertices of known depth: a longer gap, or a steeper one, may be more than one edge.
constexpr double kMaxBridgePx = 200, kMaxBridgeRatio = 1.5;
constexpr double kStraightPx = 1;       // across the chord: an edge is found to half a pixel
constexpr double kShownBetween = 0.7;   // of the nodes between lent ends
constexpr int kCornerPx = 4;            // from edge to edge: the detector cuts at junctions
constexpr float kCornerCosine = 0.85f;  // between normals: 32 degrees, else the two are one edge, or parallel
constexpr double kLentSigmas = 3;       // of a lent depth and an own one

Eigen::Vector2d position(const EdgeMap& edges, const SettledNode& s) {
  return edges.pixels[size_t(s.node.edge_pixel)].position().cast<double>();
}

// The node's own depth, however uncertain, is another.
bool contradicts(const EdgeNode& own, double idepth, double sigma) {
  return own.idepth > 0 && std::abs(own.idepth - idepth) > kLentSigmas * std::hypot(own.idepth_sigma, sigma);
}

// From one certain node to the next.
class Bridge {
 public:
  Bridge(const EdgeMap& edges, const SettledChain& chain, size_t from, size_t to)
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
      shown += !contradicts(chain_[i].node, idepth_at(i), sigma()) && is_shown(chain_[i], idepth_at(i));
    return double(shown) >= kShownBetween * double(to_ - from_ - 1);
  }

  EdgeNode node_at(size_t i) const {
    return {chain_[i].node.edge_pixel, idepth_at(i), sigma(), std::min(p_.views, q_.views),
            p_.is_outline && q_.is_outline};
  }

 private:
  double sigma() const { return std::max(p_.idepth_sigma, q_.idepth_sigma); }
  double idepth_at(size_t i) const {
    const double share = chord_.dot(position(edges_, chain_[i]) - start_) / chord_.squaredNorm();
    return p_.idepth + share * (q_.idepth - p_.idepth);
  }

  const EdgeMap& edges_;
  const SettledChain& chain_;
  const size_t from_, to_;
  const EdgeNode p_, q_;
  const Eigen::Vector2d start_, chord_;
};

// The nodes of all chains that may lend their depth, by cells of the image as wide as a corner may be.
class CornerGrid {
 public:
  CornerGrid(const EdgeMap& edges, double max_relative_sigma, const std::vector<SettledChain>& chains)
      : edges_(edges), columns_(edges.width / kCornerPx + 1) {
    cells_.resize(size_t(columns_) * size_t(edges.height / kCornerPx + 1));
    for (const SettledChain& chain : chains)
      for (const SettledNode& s : chain)
        if (s.is_known() && s.node.idepth_sigma <= max_relative_sigma * s.node.idepth)
          cells_[cell_of(pixel_of(s.node))].push_back(s.node);
  }

  // The nearest node of an edge that this one meets; null: none is near.
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

  const EdgeMap& edges_;
  int columns_;
  std::vector<std::vector<EdgeNode>> cells_;  // row by row
};

}  // namespace

void bridge_gaps(const EdgeMap& edges, const IsShown& is_shown, SettledChain* chain) {
  size_t last = chain->size();
  for (size_t i = 0; i < chain->size(); ++i) {
    if ((*chain)[i].certain == Certain::kNot) continue;
    const size_t from = std::exchange(last, i);
    if (from >= i || i - from < 2) continue;
    const Bridge bridge(edges, *chain, from, i);
    const bool is_lent = !(*chain)[from].is_known() || !(*chain)[i].is_known();
    if (!bridge.is_straight() || (is_lent && !bridge.is_shown(is_shown))) continue;
    for (size_t k = from + 1; k < i; ++k) (*chain)[k].node = bridge.node_at(k);
    for (size_t k = from; k <= i; ++k) (*chain)[k].certain = Certain::kBetweenEnds;
  }
}

void lend_at_corners(const EdgeMap& edges, double max_relative_sigma, std::vector<SettledChain>* chains) {
  const CornerGrid grid(edges, max_relative_sigma, *chains);
  for (SettledChain& chain : *chains)
    for (SettledNode& s : chain) {
      if (s.is_known() || !(s.node.idepth > 0)) continue;
      const EdgeNode* lender = grid.find(s.node);
      if (!lender || contradicts(s.node, lender->idepth, lender->idepth_sigma)) continue;
      const int edge_pixel = s.node.edge_pixel;
      s.node = *lender, s.node.edge_pixel = edge_pixel;
      s.certain = Certain::kAtCorner;
    }
}

}  // namespace edgevo
