// SPDX-License-Identifier: BSD-3-Clause
#include "plane_depths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace edgevo {
namespace {

// Share of the inverse depth: less certain nodes say little of a plane, and nothing of which one it is.
constexpr double kSampleShare = 0.03;
constexpr double kNodeSigmas = 3;                              // between a node's own depth and the plane's
constexpr int kCellPx = 16, kAroundCells = 3, kSideCells = 6;  // 50 pixels around a node, 100 next to it
constexpr int kMostTimes = 2;    // edges off the plane, for each on it, beyond which none there is looked at
constexpr int kOnEachSide = 2;   // edges on the plane
constexpr double kNextToPx = 3;  // from the edge: nearer ones are the edge itself
// Sigma of what views do not show, often a ledge or a rail, over that of the plane: where that is 2.5 to 3 %,
// half of it is wrong in the corridor.
constexpr double kLedge = 1.2;
// Share of the logarithm of the views' likelihood: what hides an edge in one view hides it in the next, as a
// fit over street, motorway and corridor says (0.15 to 0.5).
constexpr double kIndependent = 0.3;
// Edges whose depth views do not show are off the plane so many times as often as those around (same fit: 3
// to 10).
constexpr double kOftenOff = 3;
// Logarithm of the odds that an edge neither leaves nor reaches the plane between two of its pixels.
constexpr double kChange = 2;

PlaneSample sample_of(const EdgePixel& e, const FinalNode& s) {
  const double own = s.node.idepth_sigma * s.node.idepth_sigma - s.common * s.common;
  return {e.position().cast<double>(), s.node.idepth, std::sqrt(std::max(own, 1e-12)), s.common};
}
PlaneSample sample_of(const Eigen::Vector2d& px, const NodeEvidence& e) {
  return {px, e.hypothesis.idepth, 1 / std::sqrt(std::max(e.hypothesis.information, 1e-12)), e.common};
}
bool is_useful(const PlaneSample& s) {
  return s.variance() <= kSampleShare * kSampleShare * s.idepth * s.idepth;
}

// Where edges lie on the plane, and where they do not. All are added before anything is requested.
class PlaneArea {
 public:
  PlaneArea(int width, int height) : columns_(width / kCellPx + 1), rows_(height / kCellPx + 1) {
    on_.resize(size_t(columns_) * size_t(rows_));
    off_.resize(on_.size());
    around_.resize(on_.size());
  }
  void add(const Eigen::Vector2d& px, bool is_on) {
    if (is_on)
      on_[cell_of(px)].push_back(px);
    else
      ++off_[cell_of(px)];
  }
  // Logarithm of the odds that an edge here lies on the plane, by those around it.
  double log_odds(const Eigen::Vector2d& px) const { return around(px).log_odds; }
  // Whether it need not be looked at.
  bool is_mostly_off(const Eigen::Vector2d& px) const { return around(px).off > kMostTimes * around(px).on; }
  bool is_on_both_sides(const Eigen::Vector2d& px, const Eigen::Vector2d& normal) const {
    int sides[2] = {0, 0};
    each_cell(px, kSideCells, [&](size_t cell) {
      for (const Eigen::Vector2d& p : on_[cell])
        if (const double off = normal.dot(p - px); std::abs(off) > kNextToPx) ++sides[off > 0];
      return std::min(sides[0], sides[1]) < kOnEachSide;
    });
    return std::min(sides[0], sides[1]) >= kOnEachSide;
  }

 private:
  // The edges around a cell.
  struct Around {
    int on = -1, off = 0;  // on -1: not counted yet
    double log_odds = 0;
  };

  size_t cell_of(const Eigen::Vector2d& px) const {
    return size_t(int(px.y()) / kCellPx * columns_ + int(px.x()) / kCellPx);
  }
  const Around& around(const Eigen::Vector2d& px) const {
    Around& a = around_[cell_of(px)];
    if (a.on >= 0) return a;
    a.on = 0;
    each_cell(px, kAroundCells, [&](size_t cell) {
      a.on += int(on_[cell].size()), a.off += off_[cell];
      return true;
    });
    a.log_odds = std::log((a.on + 1.0) / (kOftenOff * (a.off + 1.0)));
    return a;
  }
  // Until one says that it is enough.
  template <class F>
  void each_cell(const Eigen::Vector2d& px, int reach, const F& is_more) const {
    const int column = int(px.x()) / kCellPx, row = int(px.y()) / kCellPx;
    for (int y = std::max(0, row - reach); y <= std::min(rows_ - 1, row + reach); ++y)
      for (int x = std::max(0, column - reach); x <= std::min(columns_ - 1, column + reach); ++x)
        if (!is_more(size_t(y * columns_ + x))) return;
  }

  int columns_, rows_;
  std::vector<std::vector<Eigen::Vector2d>> on_;
  std::vector<int> off_;
  mutable std::vector<Around> around_;
};

// Neighbours on one chain with depths that differ by more than their errors do not belong together.
void break_at_jumps(FinalChain* chain) {
  constexpr double kShare = 0.02;  // of the depth: as labels of a chain may differ (chain_labels.cpp)
  for (size_t i = 0; i + 1 < chain->size(); ++i) {
    const EdgeNode &a = (*chain)[i].node, &b = (*chain)[i + 1].node;
    const double tolerance =
        kNodeSigmas * std::hypot(a.idepth_sigma, b.idepth_sigma) + kShare * std::max(a.idepth, b.idepth);
    if (a.idepth > 0 && b.idepth > 0 && std::abs(a.idepth - b.idepth) > tolerance) (*chain)[i].breaks = true;
  }
}

class PlaneLayer {
 public:
  // A predicted plane is evidence, one that was found in these samples is a guess.
  PlaneLayer(const ImageEdges& edges, const PlaneLimits& limits, const EdgePlane& plane, bool is_predicted,
             const CompareDepths& compare_depths, std::vector<FinalChain>* chains)
      : edges_(edges),
        limits_(limits),
        chains_(*chains),
        plane_(plane),
        is_predicted_(is_predicted),
        compare_depths_(compare_depths),
        area_(edges.width, edges.height) {}

  // Returns the plane as it is now.
  EdgePlane lay(const WeighNode& weigh_node) {
    mark_known();
    find_candidates(weigh_node);
    if (!plane_.is_valid()) return plane_;
    area_ = PlaneArea(edges_.width, edges_.height);
    mark_known();
    for (const Candidate& c : candidates_)
      if (is_useful(c.sample) && plane_.holds(c.sample) && log_likelihood_ratio(c) > 0)
        area_.add(c.sample.px, true);
    auto candidate = candidates_.cbegin();
    for (FinalChain& chain : chains_) {
      for (FinalNode& s : chain) back(&s);
      decide(&chain, &candidate);
      break_at_jumps(&chain);
    }
    return plane_;
  }

 private:
  struct Candidate {
    FinalNode* node;
    PlaneSample sample;  // by its views, near the plane
    Hypothesis hypothesis;
    double idepth, own;  // inverse depths of the plane as found, and of the node if it lies off it
    mutable std::optional<double> log_likelihood_ratio;
  };

  const EdgePixel& pixel_of(const FinalNode& s) const { return edges_.pixels[size_t(s.node.edge_pixel)]; }

  // It looks at three or four depths, and many candidates need none.
  double log_likelihood_ratio(const Candidate& c) const {
    if (!c.log_likelihood_ratio) c.log_likelihood_ratio = compare_depths_(*c.node, c.idepth, c.own);
    return *c.log_likelihood_ratio;
  }

  // Looks at the plane for edges without a certain depth, and refines the plane with what it finds.
  void find_candidates(const WeighNode& weigh_node) {
    std::vector<PlaneSample> samples;
    for (FinalChain& chain : chains_)
      for (FinalNode& s : chain) {
        const EdgePixel& e = pixel_of(s);
        const bool is_off = s.node.idepth > 0 && !plane_.holds(sample_of(e, s));
        if (s.certain == Certain::kByViews && !is_off) samples.push_back(sample_of(e, s));
        if ((s.is_known() && !is_off) || s.node.is_on_plane) continue;
        const Eigen::Vector2d px = e.position().cast<double>();
        const double idepth = plane_.at(px).idepth;
        if (!(idepth > 0) || idepth > limits_.max_idepth || area_.is_mostly_off(px)) continue;
        const NodeEvidence evidence = weigh_node(s, idepth);
        const PlaneSample sample = sample_of(px, evidence);
        if (!plane_.holds(sample)) continue;
        candidates_.push_back(
            {&s, sample, evidence.hypothesis, idepth, is_off ? s.node.idepth : 0, std::nullopt});
        if (evidence.is_measured && is_useful(sample) && log_likelihood_ratio(candidates_.back()) > 0)
          samples.push_back(sample);
      }
    plane_ = is_predicted_ ? plane_.corrected(samples) : refined(plane_, samples);
  }

  void mark_known() {
    for (const FinalChain& chain : chains_)
      for (const FinalNode& s : chain)
        if (s.certain == Certain::kByViews || s.node.is_on_plane) {
          const PlaneSample sample = sample_of(pixel_of(s), s);
          area_.add(sample.px, plane_.holds(sample));
        }
  }

  // What the views alone show, and the plane as well, is known twice.
  void back(FinalNode* s) const {
    if (!s->is_known() || s->node.is_on_plane) return;
    const PlaneSample sample = sample_of(pixel_of(*s), *s);
    const PlaneDepth depth = plane_.at(sample.px);
    s->node.is_backed_by_plane |= depth.sigma <= limits_.max_relative_sigma * depth.idepth &&
                                  plane_.holds(sample) && area_.log_odds(sample.px) > 0;
  }

  // Logarithm of the odds that the node lies on the plane, by itself.
  double log_odds(const FinalNode& s, const Candidate* c) const {
    constexpr double kNever = -1e6;
    if (!c) return s.is_known() && plane_.holds(sample_of(pixel_of(s), s)) ? -kNever : kNever;
    const PlaneDepth depth = plane_.at(c->sample.px);
    const bool is_shown = is_useful(c->sample);
    const double sigma = is_shown ? depth.sigma : kLedge * depth.sigma;
    if (sigma > limits_.max_relative_sigma * depth.idepth || !plane_.holds(c->sample)) return kNever;
    if (!is_shown && !area_.is_on_both_sides(c->sample.px, pixel_of(s).normal().cast<double>()))
      return kNever;
    return kIndependent * log_likelihood_ratio(*c) + area_.log_odds(c->sample.px);
  }

  // Neighbours on an edge lie on the plane together: the likeliest nodes on it and off it, by Viterbi.
  void decide(FinalChain* chain, std::vector<Candidate>::const_iterator* next) {
    const size_t n = chain->size();
    std::vector<const Candidate*> candidates(n, nullptr);
    std::vector<std::array<bool, 2>> stays(n);  // whether the node before is likeliest to be alike
    double off = 0, on = 0;                     // logarithms of likelihoods
    for (size_t i = 0; i < n; ++i) {
      FinalNode& s = (*chain)[i];
      if (*next != candidates_.cend() && (*next)->node == &s) candidates[i] = &*(*next)++;
      const double change = i > 0 && (*chain)[i - 1].breaks ? 0 : kChange;
      stays[i] = {off >= on - change, on >= off - change};
      const double before = off;
      off = std::max(off, on - change), on = std::max(on, before - change) + log_odds(s, candidates[i]);
    }
    bool is_on = on > off;
    for (size_t i = n; i-- > 0; is_on = stays[i][size_t(is_on)] == is_on)
      if (is_on && candidates[i]) lay(*candidates[i]);
  }

  void lay(const Candidate& c) const {
    const PlaneDepth depth = plane_.at(c.sample.px);
    EdgeNode& node = c.node->node;
    node.idepth = depth.idepth, node.idepth_sigma = depth.sigma;
    node.views = std::max(node.views, c.hypothesis.views), node.is_outline = c.hypothesis.is_outline();
    node.is_on_plane = true;
    c.node->certain = Certain::kOnPlane;
  }

  const ImageEdges& edges_;
  const PlaneLimits& limits_;
  std::vector<FinalChain>& chains_;
  EdgePlane plane_;
  const bool is_predicted_;
  const CompareDepths& compare_depths_;
  PlaneArea area_;
  std::vector<Candidate> candidates_;
};

// Nodes whose depth says which plane it is.
std::vector<PlaneSample> known_samples(const ImageEdges& edges, const std::vector<FinalChain>& chains) {
  std::vector<PlaneSample> samples;
  for (const FinalChain& chain : chains)
    for (const FinalNode& s : chain)
      if (s.node.idepth > 0 && s.certain != Certain::kAtCorner)
        if (const PlaneSample sample = sample_of(edges.pixels[size_t(s.node.edge_pixel)], s);
            is_useful(sample))
          samples.push_back(sample);
  return samples;
}

}  // namespace

void lay_on_planes(const ImageEdges& edges, const PlaneLimits& limits, const WeighNode& weigh_node,
                   const CompareDepths& compare_depths, std::vector<EdgePlane>* planes,
                   std::vector<FinalChain>* chains) {
  const std::vector<FoundPlane> found = find_planes(known_samples(edges, *chains), std::move(*planes));
  planes->clear();
  for (const FoundPlane& f : found) {
    const EdgePlane now =
        PlaneLayer(edges, limits, f.plane, f.is_predicted, compare_depths, chains).lay(weigh_node);
    if (now.is_valid()) planes->push_back(now);
  }
}

}  // namespace edgevo
