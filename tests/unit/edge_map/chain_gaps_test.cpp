// SPDX-License-Identifier: BSD-3-Clause
// A ledge along the motion between two upright edges takes their depths at its corners.
#include "chain_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace edgevo {
namespace {

constexpr double kLeft = 0.2, kRight = 0.25, kUprightSigma = 0.001;  // inverse depths of the uprights

// One chain along `step` from `begin`, a pixel each.
void add_chain(Eigen::Vector2f begin, Eigen::Vector2f step, int pixels, ImageEdges* edges) {
  const int chain = int(edges->chains.size()), first = int(edges->pixels.size());
  for (int i = 0; i < pixels; ++i) {
    const Eigen::Vector2f p = begin + float(i) * step;
    edges->pixels.push_back({p.x(), p.y(), -step.y(), step.x(), 10, chain});
  }
  edges->chains.push_back({first, first + pixels});
}

FinalChain chain_nodes(const EdgeChain& chain, double idepth, double sigma, Certain certain) {
  FinalChain nodes;
  for (int i = chain.begin; i < chain.end; i += 3) nodes.push_back({{i, idepth, sigma, 6}, certain});
  return nodes;
}

struct Ledge {
  Ledge() {
    edges.width = 120, edges.height = 100;
    add_chain({20, 50}, {1, 0}, 61, &edges);  // its last node is its last pixel
    add_chain({17.5f, 20}, {0, 1}, 60, &edges);
    add_chain({82.5f, 20}, {0, 1}, 60, &edges);
    chains = {chain_nodes(edges.chains[0], 0.23, 0.02, Certain::kNot),
              chain_nodes(edges.chains[1], kLeft, kUprightSigma, Certain::kByViews),
              chain_nodes(edges.chains[2], kRight, kUprightSigma, Certain::kByViews)};
  }

  int known(bool is_shown = true, double max_relative_sigma = 0.01) {
    copy_depth_at_corners(edges, max_relative_sigma, &chains);
    const auto shown = [is_shown](const FinalNode&, double) { return is_shown; };
    bridge_gaps(edges, shown, &chains[0]);
    return int(
        std::count_if(chains[0].begin(), chains[0].end(), [](const FinalNode& s) { return s.is_known(); }));
  }
  void set_own_depth(double idepth, double sigma) {
    for (FinalNode& s : chains[0]) s.node.idepth = idepth, s.node.idepth_sigma = sigma;
  }

  ImageEdges edges;
  std::vector<FinalChain> chains;
};

TEST(ChainGaps, ALedgeTakesTheDepthsOfTheUprightsAtItsCorners) {
  Ledge ledge;
  ASSERT_EQ(ledge.known(), 21);
  for (int i = 0; i < 21; ++i)
    EXPECT_NEAR(ledge.chains[0][size_t(i)].node.idepth, kLeft + (kRight - kLeft) * i / 20, 1e-9) << i;
}

TEST(ChainGaps, OneCornerAloneIsNotEnough) {
  Ledge ledge;
  ledge.chains.pop_back();
  EXPECT_EQ(ledge.known(), 0);
}

TEST(ChainGaps, AGapThatNoViewShowsIsNotBridged) { EXPECT_EQ(Ledge().known(false), 0); }

TEST(ChainGaps, ALedgeWithoutAnyDepthOfItsOwnGetsNone) {
  Ledge ledge;
  ledge.set_own_depth(0, 0);
  EXPECT_EQ(ledge.known(), 0);
}

TEST(ChainGaps, TheDepthOfAnUprightInFrontIsNotCopied) {
  Ledge ledge;
  ledge.set_own_depth(0.1, 0.02);
  EXPECT_EQ(ledge.known(), 0);
}

TEST(ChainGaps, TheDepthOfAnUncertainUprightIsNotCopied) { EXPECT_EQ(Ledge().known(true, 0.003), 0); }

TEST(ChainGaps, TheDepthOfAParallelEdgeIsNotCopied) {
  Ledge ledge;
  ledge.edges.chains.resize(1), ledge.edges.pixels.resize(61), ledge.chains.resize(1);
  add_chain({20, 52}, {1, 0}, 61, &ledge.edges);
  ledge.chains.push_back(chain_nodes(ledge.edges.chains[1], kLeft, kUprightSigma, Certain::kByViews));
  EXPECT_EQ(ledge.known(), 0);
}

TEST(ChainGaps, AGapBetweenTwoKnownEndsNeedsNoView) {
  Ledge ledge;
  ledge.chains.resize(1);
  ledge.chains[0].front() = {{0, kLeft, kUprightSigma, 6}, Certain::kByViews};
  ledge.chains[0].back() = {{60, kRight, kUprightSigma, 6}, Certain::kByViews};
  EXPECT_EQ(ledge.known(false), 21);
}

TEST(ChainGaps, ABreakIsNotBridged) {
  Ledge ledge;
  ledge.chains[0][10].breaks = true;
  EXPECT_EQ(ledge.known(), 0);
}

}  // namespace
}  // namespace edgevo
