// SPDX-License-Identifier: BSD-3-Clause
#include "plane_depths.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

// Share of the inverse depth: less certain nodes say little of a plane, and nothing of which one it is.
constexpr double kSampleShare = 0.03;
constexpr double kNodeSigmas = 3;                              // between a node's own depth and the plane's
constexpr int kCellPx = 16, kAroundCells = 3, kSideCells = 6;  // 50 pixels around a node, 100 next to it
constexpr int kMostTimes = 2;                                  // on the plane, for each edge off it
constexpr int kOnEachSide = 2;                                 // edges on the plane
constexpr double kNextToPx = 3;  // from the edge: nearer ones are the edge itself

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

// Where edges lie on the plane, and where they do not.
class PlaneArea {
 public:
  PlaneArea(int width, int height) : columns_(width / kCellPx + 1), rows_(height / kCellPx + 1) {
    on_.resize(size_t(columns_) * size_t(rows_));
    off_.resize(on_.size());
  }
  void add(const Eigen::Vector2d& px, bool is_on) {
    const size_t cell = size_t(int(px.y()) / kCellPx * columns_ + int(px.x()) / kCellPx);
    if (is_on)
      on_[cell].push_back(px);
    else
      ++off_[cell];
  }
  bool is_mostly_plane(const Eigen::Vector2d& px) const {
    int on = 0, off = 0;
    each_cell(px, kAroundCells, [&](size_t cell) { on += int(on_[cell].size()), off += off_[cell]; });
    return on >= kOnEachSide && on >= kMostTimes * off;
  }
  // Whether it need not be looked at.
  bool is_mostly_off(const Eigen::Vector2d& px) const {
    int on = 0, off = 0;
    each_cell(px, kAroundCells, [&](size_t cell) { on += int(on_[cell].size()), off += off_[cell]; });
    return off > kMostTimes * on;
  }
  bool is_on_both_sides(const Eigen::Vector2d& px, const Eigen::Vector2d& normal) const {
    int sides[2] = {0, 0};
    each_cell(px, kSideCells, [&](size_t cell) {
      for (const Eigen::Vector2d& p : on_[cell])
        if (const double off = normal.dot(p - px); std::abs(off) > kNextToPx) ++sides[off > 0];
    });
    return std::min(sides[0], sides[1]) >= kOnEachSide;
  }

 private:
  template <class F>
  void each_cell(const Eigen::Vector2d& px, int reach, const F& f) const {
    const int column = int(px.x()) / kCellPx, row = int(px.y()) / kCellPx;
    for (int y = std::max(0, row - reach); y <= std::min(rows_ - 1, row + reach); ++y)
      for (int x = std::max(0, column - reach); x <= std::min(columns_ - 1, column + reach); ++x)
        f(size_t(y * columns_ + x));
  }

  int columns_, rows_;
  std::vector<std::vector<Eigen::Vector2d>> on_;
  std::vector<int> off_;
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
             std::vector<FinalChain>* chains)
      : edges_(edges),
        limits_(limits),
        chains_(*chains),
        plane_(plane),
        is_predicted_(is_predicted),
        area_(edges.width, edges.height) {}

  // Returns the plane as it is now.
  EdgePlane lay(const WeighNode& weigh_node) {
    mark_known();
    find_candidates(weigh_node);
    if (!plane_.is_valid()) return plane_;
    area_ = PlaneArea(edges_.width, edges_.height);
    mark_known();
    for (const Candidate& c : candidates_)
      if (is_useful(c.sample) && plane_.holds(c.sample)) area_.add(c.sample.px, true);
    for (const Candidate& c : candidates_) decide(c);
    for (FinalChain& chain : chains_) break_at_jumps(&chain);
    return plane_;
  }

 private:
  struct Candidate {
    FinalNode* node;
    PlaneSample sample;  // by its views, near the plane
    const Hypothesis hypothesis;
  };

  const EdgePixel& pixel_of(const FinalNode& s) const { return edges_.pixels[size_t(s.node.edge_pixel)]; }

  // Looks at the plane for edges without a certain depth, and refines the plane with what it finds.
  void find_candidates(const WeighNode& weigh_node) {
    std::vector<PlaneSample> samples;
    for (FinalChain& chain : chains_)
      for (FinalNode& s : chain) {
        const EdgePixel& e = pixel_of(s);
        const bool is_off = s.node.idepth > 0 && !plane_.holds(sample_of(e, s));
        if (s.certain == Certain::kByViews && !is_off) samples.push_back(sample_of(e, s));
        if (s.is_known() && !is_off) continue;
        const Eigen::Vector2d px = e.position().cast<double>();
        const double idepth = plane_.at(px).idepth;
        if (!(idepth > 0) || idepth > limits_.max_idepth || area_.is_mostly_off(px)) continue;
        const NodeEvidence evidence = weigh_node(s, idepth, is_off ? s.node.idepth : 0);
        if (!evidence.is_likely) continue;
        candidates_.push_back({&s, sample_of(px, evidence), evidence.hypothesis});
        if (evidence.is_measured && is_useful(candidates_.back().sample))
          samples.push_back(candidates_.back().sample);
      }
    plane_ = is_predicted_ ? plane_.corrected(samples) : refined(plane_, samples);
  }

  void mark_known() {
    for (const FinalChain& chain : chains_)
      for (const FinalNode& s : chain)
        if (s.certain == Certain::kByViews) {
          const PlaneSample sample = sample_of(pixel_of(s), s);
          area_.add(sample.px, plane_.holds(sample));
        }
  }

  void decide(const Candidate& c) {
    const PlaneDepth depth = plane_.at(c.sample.px);
    if (depth.sigma > limits_.max_relative_sigma * depth.idepth || !plane_.holds(c.sample)) return;
    if (!area_.is_mostly_plane(c.sample.px)) return;
    if (!is_useful(c.sample) &&
        !area_.is_on_both_sides(c.sample.px, pixel_of(*c.node).normal().cast<double>()))
      return;
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

void lay_on_plane(const ImageEdges& edges, const PlaneLimits& limits, const WeighNode& weigh_node,
                  std::optional<EdgePlane>* plane, std::vector<FinalChain>* chains) {
  bool is_predicted = false;
  const EdgePlane found = find_plane(known_samples(edges, *chains), *plane, &is_predicted);
  plane->reset();
  if (!found.is_valid()) return;
  const EdgePlane now = PlaneLayer(edges, limits, found, is_predicted, chains).lay(weigh_node);
  if (now.is_valid()) *plane = now;
}

}  // namespace edgevo
