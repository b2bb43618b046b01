// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edge_map/edge_depth.h"

#include <algorithm>
#include <cmath>

#include "chain_gaps.h"
#include "chain_labels.h"
#include "chain_smoothing.h"
#include "epipolar_crossings.h"
#include "plane_depths.h"

namespace edgevo {
namespace {

constexpr int kSearchedViews = 2;     // views searched for crossings: the point may be occluded in one
constexpr int kSearchEveryPx = 12;    // along the edge; in between, hypotheses are carried along
constexpr int kMaxHypotheses = 3;     // kept per pixel
constexpr double kSameIdepth = 0.03;  // hypotheses within this share are merged
constexpr double kMinSupport = 0.5;   // share of the views containing a point that must show it
// Error common to all views, due to pose or lens: no number of views averages it out.
constexpr double kCommonPx = 0.25;
// Share of max_relative_sigma for a depth that is copied at a corner: a bridge rests on two nodes alone.
constexpr double kCornerSourceShare = 0.5;
// Tolerance between two depths: standard deviations, and share of the depth.
constexpr double kShownSigmas = 2, kShownShare = 0.02;

class DepthSearch {
 public:
  DepthSearch(const Pinhole& pinhole, const FramePyramid& host, const std::vector<EdgeSides>& sides,
              const std::vector<EdgeView>& views, double max_idepth, const EdgeMapParams& params,
              std::vector<EdgePlane>* planes, std::vector<TracedPixel>* trace,
              const std::vector<double>& known)
      : level_(host.finest()),
        sides_(sides),
        max_idepth_(max_idepth),
        params_(params),
        planes_(planes),
        trace_(trace),
        known_(known),
        set_(pinhole, views) {
    if (trace_) trace_->assign(level_.edges.pixels.size(), {});
  }

  std::vector<EdgePiece> run() {
    for (const EdgeChain& chain : level_.edges.chains) follow(chain);
    copy_depth_at_corners(level_.edges, kCornerSourceShare * params_.max_relative_sigma, &chains_);
    for (FinalChain& chain : chains_) bridge(&chain);
    lay_on_planes();
    for (const FinalChain& chain : chains_) collect(chain);
    return std::move(pieces_);
  }

 private:
  void follow(const EdgeChain& chain) {
    // From the first pixel to the last: with whole steps, short edges lost half of one at their ends.
    const int last = chain.length() - 1, steps = (last + params_.step_px - 1) / params_.step_px;
    std::vector<ChainNode> nodes;
    nodes.reserve(size_t(steps) + 1);
    int next_search = chain.begin, in_vain = 0;
    for (int k = 0; k <= steps; ++k) {
      const int i = chain.begin + (k > 0 ? k * last / steps : 0);
      look_from(i);
      ChainNode node = spare_node();
      node.edge_pixel = i;
      node.at = i - chain.begin;
      reached(i, EdgeStage::kNoCrossing);
      if (!nodes.empty()) carry_along(nodes.back(), &node);
      if (i >= next_search && !has_sure_depth(node) && !has_known_depth(&node)) {
        search(&node);
        in_vain = node.hypotheses.empty() ? in_vain + 1 : 0;
        next_search = i + (1 + in_vain) * kSearchEveryPx;
      }
      keep_best(&node.hypotheses);
      nodes.push_back(std::move(node));
    }
    finish(&nodes);
  }

  void look_from(int i) {
    const EdgePixel& e = level_.edges.pixels[size_t(i)];
    sight_.px = e.position().cast<double>();
    const size_t next = std::min(size_t(i + params_.step_px), level_.edges.pixels.size() - 1);
    sight_.to_next = level_.edges.pixels[next].position() - e.position(), sight_.step = params_.step_px;
    sight_.normal = e.normal().cast<double>();
    sight_.sides = sides_[size_t(i)];
    look_along(set_, sight_.px, sight_.normal, &sight_.lines);
  }

  bool is_supported(const Hypothesis& h) const {
    return h.views >= params_.min_views && h.views >= kMinSupport * h.in_view && h.idepth > 0;
  }

  void try_out(double idepth, Guess guess, ChainNode* node) const {
    const Hypothesis h = weigh(sight_, set_, idepth, guess, max_idepth_, params_);
    if (is_supported(h) && h.informative > 0) node->hypotheses.push_back(h);
    reached(node->edge_pixel, h.views < params_.min_views ? EdgeStage::kFewViews
                              : !is_supported(h)          ? EdgeStage::kNoSupport
                              : h.informative == 0        ? EdgeStage::kNoMotion
                                                          : EdgeStage::kNotChosen);
  }

  void carry_along(const ChainNode& from, ChainNode* to) const {
    for (const Hypothesis& h : from.hypotheses) try_out(h.idepth, Guess::kCarriedAlong, to);
  }

  // Whether views show a carried depth so well that until the next search no other could pay for a jump.
  bool has_sure_depth(const ChainNode& node) const {
    const double nodes = double(kSearchEveryPx) / params_.step_px;
    return std::any_of(node.hypotheses.begin(), node.hypotheses.end(),
                       [&](const Hypothesis& h) { return nodes * h.cost < kBreakCost; });
  }

  // Whether views show the depth that earlier lines have here: most of an edge has been searched before.
  bool has_known_depth(ChainNode* node) const {
    const double known = known_.empty() ? 0 : known_[size_t(node->edge_pixel)];
    if (!(known > 0)) return false;
    const size_t before = node->hypotheses.size();
    try_out(known, Guess::kCarriedAlong, node);
    return node->hypotheses.size() > before && is_same(known, node->hypotheses.back().idepth);
  }

  void search(ChainNode* node) const {
    std::vector<double> idepths;
    int searched = 0;
    for (size_t v = 0; v < set_.views.size() && searched < kSearchedViews; ++v)
      searched += find_crossings(sight_, set_.views[v], max_idepth_, &idepths);
    for (const double idepth : distinct(std::move(idepths))) try_out(idepth, Guess::kRough, node);
  }

  // Hypotheses found further along are also carried back.
  void carry_back(std::vector<ChainNode>* nodes) {
    for (size_t k = nodes->size(); k-- > 1;) {
      ChainNode& to = (*nodes)[k - 1];
      if (!to.hypotheses.empty() || (*nodes)[k].hypotheses.empty()) continue;
      look_from(to.edge_pixel);
      carry_along((*nodes)[k], &to);
      keep_best(&to.hypotheses);
    }
  }

  static bool is_same(double a, double b) { return std::abs(a - b) < kSameIdepth * b; }

  static std::vector<double> distinct(std::vector<double> idepths) {
    std::sort(idepths.begin(), idepths.end());
    idepths.erase(std::unique(idepths.begin(), idepths.end(),
                              [](double a, double b) { return b - a < kSameIdepth * b; }),
                  idepths.end());
    return idepths;
  }

  // The cheapest hypotheses, one for each depth.
  static void keep_best(std::vector<Hypothesis>* hypotheses) {
    std::sort(hypotheses->begin(), hypotheses->end(), [](const Hypothesis& a, const Hypothesis& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.idepth < b.idepth;
    });
    auto best_end = hypotheses->begin();
    for (const Hypothesis& h : *hypotheses) {
      const bool is_there = std::any_of(hypotheses->begin(), best_end,
                                        [&](const Hypothesis& b) { return is_same(h.idepth, b.idepth); });
      if (!is_there && best_end - hypotheses->begin() < kMaxHypotheses) *best_end++ = h;
    }
    hypotheses->erase(best_end, hypotheses->end());
  }

  // Labels the nodes and smooths their depths.
  void finish(std::vector<ChainNode>* nodes) {
    if (int(nodes->size()) >= params_.min_vertices) {
      carry_back(nodes);
      const ChainLabels labels = label_chain(*nodes);
      FinalChain chain(nodes->size());
      size_t begin = 0;
      for (size_t i = 0; i < nodes->size(); ++i) {
        chain[i].node.edge_pixel = (*nodes)[i].edge_pixel;
        if (!labels.breaks[i]) continue;
        chain[i].breaks = i + 1 < nodes->size() && labels.label[i] >= 0 && labels.label[i + 1] >= 0;
        if (labels.label[i] >= 0) smooth_piece(*nodes, labels.label, begin, i + 1, &chain);
        begin = i + 1;
      }
      bridge(&chain);
      chains_.push_back(std::move(chain));
    }
    for (ChainNode& node : *nodes) spare_.push_back(std::move(node.hypotheses));
    nodes->clear();
  }

  // With the memory of an earlier one.
  ChainNode spare_node() {
    ChainNode node;
    if (spare_.empty()) return node;
    node.hypotheses = std::move(spare_.back());
    node.hypotheses.clear();
    spare_.pop_back();
    return node;
  }

  void smooth_piece(const std::vector<ChainNode>& nodes, const std::vector<int>& label, size_t begin,
                    size_t end, FinalChain* chain) const {
    std::vector<ChainValue> values;
    for (size_t i = begin; i < end; ++i) {
      const Hypothesis& h = nodes[i].hypotheses[size_t(label[i])];
      values.push_back({nodes[i].at, h.idepth, 1 / h.information, kCommonPx / mean_slope(h)});
    }
    const std::vector<SmoothValue> smooth = smooth_chain(values);
    for (size_t i = begin; i < end; ++i) {
      const Hypothesis& h = nodes[i].hypotheses[size_t(label[i])];
      const SmoothValue& s = smooth[i - begin];
      FinalNode& to = (*chain)[i];
      to.node = {nodes[i].edge_pixel, s.value, s.sigma, h.views, h.is_outline()};
      to.common = values[i - begin].common;
      const double limit = params_.max_relative_sigma * s.value;
      if (s.value > 0 && s.sigma <= limit) to.certain = Certain::kByViews;
      const bool may_help = values[i - begin].common <= limit;
      trace_depth(to.node);
      reached(to.node.edge_pixel, to.is_known() ? EdgeStage::kShort
                                  : may_help    ? EdgeStage::kUncertain
                                                : EdgeStage::kAlongMotion);
    }
  }

  void bridge(FinalChain* chain) {
    const auto shown = [this](const FinalNode& s, double idepth) { return is_shown(s.node, idepth); };
    bridge_gaps(level_.edges, shown, chain);
  }

  // Whether views see an edge there, and no evidence that it is nearer or farther.
  bool is_shown(const EdgeNode& node, double idepth) {
    look_from(node.edge_pixel);
    const Hypothesis h = weigh(sight_, set_, idepth, Guess::kCarriedAlong, max_idepth_, params_);
    return is_supported(h) &&
           (node.idepth > 0 ||
            std::abs(h.idepth - idepth) <
                kShownSigmas / std::sqrt(std::max(h.information, 1e-12)) + kShownShare * idepth);
  }

  void lay_on_planes() {
    const WeighNode weigh_node = [this](const FinalNode& s, double idepth) {
      look_from(s.node.edge_pixel);
      const Hypothesis h = weigh(sight_, set_, idepth, Guess::kCarriedAlong, max_idepth_, params_);
      return NodeEvidence{h, h.information > 0 ? kCommonPx / mean_slope(h) : max_idepth_,
                          h.views >= params_.min_views};
    };
    const CompareDepths compare_depths = [this](const FinalNode& s, double idepth, double own) {
      look_from(s.node.edge_pixel);
      return log_likelihood_ratio(sight_, set_, idepth, own, max_idepth_, params_);
    };
    edgevo::lay_on_planes(level_.edges, {max_idepth_, params_.max_relative_sigma}, weigh_node, compare_depths,
                          planes_, &chains_);
  }

  void collect(const FinalChain& chain) {
    EdgePiece piece;
    const auto flush = [&] {
      if (int(piece.size()) >= params_.min_vertices) {
        pieces_.push_back(piece);
        for (const EdgeNode& n : piece) found(n);
      }
      piece.clear();
    };
    for (const FinalNode& s : chain) {
      if (s.is_known()) piece.push_back(s.node);
      if (!s.is_known() || s.breaks) flush();
    }
    flush();
  }

  // Root mean square of J: an error common to all views moves the depth by that error over J.
  double mean_slope(const Hypothesis& h) const { return kEdgeSigmaPx * std::sqrt(h.information / h.views); }

  void reached(int edge_pixel, EdgeStage gate) const {
    if (trace_) (*trace_)[size_t(edge_pixel)].reach(gate);
  }
  void found(const EdgeNode& node) const {
    reached(node.edge_pixel, EdgeStage::kFound);
    trace_depth(node);
  }
  void trace_depth(const EdgeNode& node) const {
    if (trace_) (*trace_)[size_t(node.edge_pixel)].idepth = node.idepth;
  }

  const PyramidLevel& level_;
  const std::vector<EdgeSides>& sides_;
  const double max_idepth_;
  const EdgeMapParams& params_;
  std::vector<EdgePlane>* planes_;
  std::vector<TracedPixel>* trace_;   // may be null
  const std::vector<double>& known_;  // inverse depths of earlier lines by edge pixel, 0: none; or empty
  ViewSet set_;
  EdgeSight sight_;  // of the current pixel
  std::vector<std::vector<Hypothesis>> spare_;
  std::vector<FinalChain> chains_;
  std::vector<EdgePiece> pieces_;
};

}  // namespace

std::vector<EdgePiece> find_edge_depths(const Pinhole& pinhole, const FramePyramid& host,
                                        const std::vector<EdgeSides>& sides,
                                        const std::vector<EdgeView>& views, double max_idepth,
                                        const EdgeMapParams& params, std::vector<EdgePlane>* planes,
                                        std::vector<TracedPixel>* trace, const std::vector<double>& known) {
  std::vector<EdgePlane> none;
  return DepthSearch(pinhole, host, sides, views, max_idepth, params, planes ? planes : &none, trace, known)
      .run();
}

}  // namespace edgevo
