// SPDX-License-Identifier: BSD-3-Clause
// Dynamic programming along a chain: it selects the continuous hypothesis, breaks where depth jumps, and
// selects none where nothing fits.
#include "chain_labels.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

Hypothesis hypothesis(double idepth, double cost) {
  Hypothesis h;
  h.idepth = idepth;
  h.information = 1e6;  // a standard deviation of 0.001
  h.cost = cost;
  h.in_view = 6;
  h.views = 6 - int(cost);
  return h;
}

ChainNode node(int i, std::vector<Hypothesis> hypotheses) { return {i, 3.0 * i, std::move(hypotheses)}; }

TEST(ChainLabels, AWrongMatchThatIsCheaperGivesWayToItsNeighbours) {
  std::vector<ChainNode> nodes;
  for (int i = 0; i < 9; ++i)
    nodes.push_back(node(i, {hypothesis(0.1, 1.0), hypothesis(0.02 * i + 0.3, 0.7)}));
  nodes[4].hypotheses[1].cost = 0.2;  // by far the best here, and no neighbour agrees
  const ChainLabels labels = label_chain(nodes);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(labels.label[size_t(i)], 0) << i;
  for (int i = 0; i < 8; ++i) EXPECT_FALSE(labels.breaks[size_t(i)]) << i;
}

TEST(ChainLabels, DepthMayJumpOnce) {
  std::vector<ChainNode> nodes;
  for (int i = 0; i < 10; ++i)
    nodes.push_back(node(i, {hypothesis(i < 5 ? 0.1 : 0.3, 0.5), hypothesis(0.9 - 0.05 * i, 2.5)}));
  const ChainLabels labels = label_chain(nodes);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(labels.label[size_t(i)], 0) << i;
  for (int i = 0; i < 9; ++i) EXPECT_EQ(labels.breaks[size_t(i)], i == 4) << i;
}

TEST(ChainLabels, NoDepthWhereMostViewsDoNotShowTheEdge) {
  std::vector<ChainNode> nodes;
  for (int i = 0; i < 12; ++i) nodes.push_back(node(i, {hypothesis(0.2, i < 6 ? 0.5 : 4.5)}));
  const ChainLabels labels = label_chain(nodes);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(labels.label[size_t(i)], i < 6 ? 0 : -1) << i;
}

TEST(ChainLabels, NodesWithoutHypothesesAndNoNodes) {
  EXPECT_TRUE(label_chain({}).label.empty());
  const ChainLabels labels = label_chain({node(0, {}), node(1, {})});
  EXPECT_EQ(labels.label, (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace edgevo
