// SPDX-License-Identifier: BSD-3-Clause
#include "chain_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace edgevo {
namespace {

// Costs in units of views that do not show the edge.
constexpr double kNoneShare = 0.5;    // of the views that contain the pixel, if it has no depth
constexpr double kNoneAtLeast = 1.0;  // lower bound where few views contain it
constexpr double kBeginOrEnd = 0.5;   // from a depth to none, or back
// Where an edge continues, inverse depths of neighbours two pixels apart differ by this share plus their
// standard deviations: an edge that leads away at 60 degrees does so 20 pixels from the focus of expansion.
constexpr double kSmoothShare = 0.02;

double own_cost(const ChainNode& node, int label) {
  if (label >= 0) return node.hypotheses[size_t(label)].cost;
  int in_view = 0;
  for (const Hypothesis& h : node.hypotheses) in_view = std::max(in_view, h.in_view);
  return std::max(kNoneAtLeast, kNoneShare * in_view);
}

double squared_jump(const Hypothesis& a, const Hypothesis& b) {
  const double share = kSmoothShare * std::max(a.idepth, b.idepth);
  const double variance =
      share * share + 1 / std::max(a.information, 1e-12) + 1 / std::max(b.information, 1e-12);
  return std::pow(a.idepth - b.idepth, 2) / variance;
}

bool is_break(const ChainNode& a, int la, const ChainNode& b, int lb) {
  constexpr double kJump = 9;  // three standard deviations, squared
  return la < 0 || lb < 0 || squared_jump(a.hypotheses[size_t(la)], b.hypotheses[size_t(lb)]) > kJump;
}

double step_cost(const ChainNode& a, int la, const ChainNode& b, int lb) {
  if (la < 0 && lb < 0) return 0;
  if (la < 0 || lb < 0) return kBeginOrEnd;
  constexpr double kWeight = kBreakCost / 9;  // reaches the cost of a break at three standard deviations
  return std::min(kBreakCost, kWeight * squared_jump(a.hypotheses[size_t(la)], b.hypotheses[size_t(lb)]));
}

}  // namespace

ChainLabels label_chain(const std::vector<ChainNode>& nodes) {
  const size_t n = nodes.size();
  ChainLabels result{std::vector<int>(n, -1), std::vector<bool>(n, true)};
  if (n == 0) return result;
  // Label l of a node is stored at l + 1, those of all nodes one after another.
  std::vector<size_t> begin(n);
  size_t all = 0;
  for (size_t i = 0; i < n; ++i) begin[i] = std::exchange(all, all + nodes[i].hypotheses.size() + 1);
  std::vector<int> from(all, -1);
  std::vector<double> cost, next;
  for (size_t i = 0; i < n; ++i) {
    const int labels = int(nodes[i].hypotheses.size());
    next.assign(size_t(labels) + 1, std::numeric_limits<double>::infinity());
    for (int l = -1; l < labels; ++l) {
      double best = i == 0 ? 0 : std::numeric_limits<double>::infinity();
      for (int k = -1; i > 0 && k + 1 < int(cost.size()); ++k) {
        const double c = cost[size_t(k + 1)] + step_cost(nodes[i - 1], k, nodes[i], l);
        if (c < best) best = c, from[begin[i] + size_t(l + 1)] = k;
      }
      next[size_t(l + 1)] = best + own_cost(nodes[i], l);
    }
    cost.swap(next);
  }
  int label = int(std::min_element(cost.begin(), cost.end()) - cost.begin()) - 1;
  for (size_t i = n; i-- > 0;) {
    result.label[i] = label;
    label = from[begin[i] + size_t(label + 1)];
  }
  for (size_t i = 0; i + 1 < n; ++i)
    result.breaks[i] = is_break(nodes[i], result.label[i], nodes[i + 1], result.label[i + 1]);
  return result;
}

}  // namespace edgevo
