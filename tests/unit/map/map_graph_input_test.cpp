// SPDX-License-Identifier: BSD-3-Clause
// What MapGraph refuses: each with one line, and nothing changes.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "edgevo/map/map_graph.h"
#include "support/graph_scene.h"

namespace edgevo {
namespace {

using test::covariance_of;
using test::kUnmeasured;
using ::testing::HasSubstr;
using ::testing::Not;

const NodeId kKnown = NodeId::keyframe(1), kUnknown = NodeId::epoch(2, 0);

// What a call says that must refuse.
std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "not refused";
}

class MapGraphInput : public ::testing::Test {
 protected:
  MapGraphInput() {
    graph_.add_node(kKnown, Sim3());
    graph_.add(valid());
  }

  static Constraint valid() {
    Constraint c;
    c.to = kKnown;
    c.covariance = covariance_of(0.1, 0.1, 0.1);
    c.kind = ConstraintKind::kSpeed;
    return c;
  }

  // The message of a constraint that `spoil` made invalid; the graph must be as before.
  std::string message_of(const std::function<void(Constraint*)>& spoil) {
    Constraint c = valid();
    spoil(&c);
    const std::string message = refusal([&] { graph_.add(c); });
    EXPECT_EQ(graph_.constraints().size(), 1u);
    EXPECT_EQ(graph_.nodes().size(), 2u);
    EXPECT_THAT(message, Not(HasSubstr("\n")));
    return message;
  }

  MapGraph graph_;
};

TEST_F(MapGraphInput, NamesTheConstraintAndTheNode) {
  EXPECT_EQ(message_of([](Constraint* c) { c->to = kUnknown; }),
            "constraint world -> epoch 2/0 (speed): node epoch 2/0 is not known");
  EXPECT_THAT(message_of([](Constraint* c) { c->to = NodeId::world(); }),
              HasSubstr("both ends are one node"));
}

TEST_F(MapGraphInput, RefusesSimilaritiesThatAreNone) {
  EXPECT_EQ(message_of([](Constraint* c) { c->T_from_to.scale = -1; }),
            "constraint world -> keyframe 1 (speed): scale -1 is not positive");
  EXPECT_THAT(message_of([](Constraint* c) { c->T_from_to.scale = 0; }),
              HasSubstr("scale 0 is not positive"));
  EXPECT_THAT(message_of([](Constraint* c) { c->T_from_to.scale = std::nan(""); }), HasSubstr("not finite"));
  EXPECT_THAT(message_of([](Constraint* c) {
                c->T_from_to.rigid = SE3(Eigen::Quaterniond::Identity(), {std::nan(""), 0, 0});
              }),
              HasSubstr("not finite"));
  EXPECT_THAT(message_of([](Constraint* c) { c->centre.x() = kUnmeasured; }),
              HasSubstr("centre is not finite"));
}

TEST_F(MapGraphInput, RefusesCovariancesThatAreNone) {
  EXPECT_THAT(message_of([](Constraint* c) { c->covariance(0, 1) = 1e-3; }), HasSubstr("not symmetric"));
  EXPECT_THAT(message_of([](Constraint* c) { c->covariance(2, 2) = std::nan(""); }), HasSubstr("NaN"));
  EXPECT_THAT(message_of([](Constraint* c) { c->covariance(0, 1) = std::nan(""); }), HasSubstr("NaN"));
  EXPECT_THAT(message_of([](Constraint* c) { c->covariance(0, 1) = c->covariance(1, 0) = 1; }),
              HasSubstr("not positive definite"));
  EXPECT_THAT(message_of([](Constraint* c) { c->covariance(3, 3) = -1; }),
              HasSubstr("variance -1 of w.x is not positive"));
  EXPECT_THAT(message_of([](Constraint* c) { c->covariance(3, 3) = 0; }), HasSubstr("not positive definite"));
  EXPECT_THAT(message_of([](Constraint* c) { c->covariance(3, 3) = -kUnmeasured; }),
              HasSubstr("not positive"));
  EXPECT_THAT(message_of([](Constraint* c) {
                c->covariance(3, 3) = kUnmeasured;
                c->covariance(3, 4) = c->covariance(4, 3) = 1e-3;
              }),
              HasSubstr("row and column of w.x must be 0, as its variance is inf"));
  EXPECT_THAT(message_of([](Constraint* c) {
                c->covariance(6, 6) = 0;
                c->covariance(6, 4) = c->covariance(4, 6) = 1e-3;
              }),
              HasSubstr("row and column of sigma must be 0, as its variance is 0"));
  EXPECT_THAT(
      message_of([](Constraint* c) { c->covariance = covariance_of(kUnmeasured, kUnmeasured, kUnmeasured); }),
      HasSubstr("nothing is measured"));
}

TEST_F(MapGraphInput, RefusesFailuresThatAreNone) {
  const Matrix7d wide = covariance_of(1, 1, 1);
  for (const double p : {-0.1, 1.0, std::nan("")})
    EXPECT_THAT(message_of([&](Constraint* c) { c->failure = {p, wide}; }), HasSubstr("not in [0, 1)"));
  EXPECT_THAT(message_of([](Constraint* c) {
                c->failure = {0.1, -covariance_of(1, 1, 1)};
              }),
              Not(HasSubstr("not refused")));
  EXPECT_THAT(message_of([](Constraint* c) {
                c->failure = {0.1, covariance_of(1, 1, kUnmeasured)};
              }),
              HasSubstr("sigma has variance 0.01, and inf in the failure"));
  EXPECT_THAT(message_of([](Constraint* c) {
                c->failure = {0.1, covariance_of(1, 1, 0)};
              }),
              HasSubstr("both or neither"));
  EXPECT_THAT(message_of([](Constraint* c) {
                c->failure = {0.1, covariance_of(0.01, 0.01, 0.01)};
              }),
              HasSubstr("smaller than that without"));
}

TEST_F(MapGraphInput, RefusesExactScalesThatContradict) {
  const auto exact = [&](NodeId from, NodeId to, double scale) {
    Constraint c = valid();
    c.from = from, c.to = to, c.T_from_to.scale = scale, c.covariance = covariance_of(1, 1, 0);
    return graph_.add(c);
  };
  graph_.add_node(kUnknown, Sim3());
  const int first = exact(NodeId::world(), kKnown, 2);
  exact(kUnknown, kKnown, 4);
  EXPECT_THAT(refusal([&] { exact(kUnknown, NodeId::world(), 3); }),
              HasSubstr("exact scale 3 contradicts 2 from other exact scales"));
  EXPECT_EQ(graph_.constraints().size(), 3u);
  graph_.withdraw(first);
  exact(kUnknown, NodeId::world(), 3);
}

TEST_F(MapGraphInput, RefusesNodes) {
  EXPECT_EQ(refusal([&] { graph_.add_node(kKnown, Sim3()); }), "node keyframe 1: there is one already");
  EXPECT_EQ(refusal([&] { graph_.add_node(NodeId::world(), Sim3()); }), "node world: there is one already");
  EXPECT_EQ(refusal([&] {
              graph_.add_node(kUnknown, Sim3{0, SE3()});
            }),
            "node epoch 2/0: scale 0 is not positive");
  EXPECT_EQ(refusal([&] { graph_.set_guess(kUnknown, Sim3()); }), "node epoch 2/0: it is not known");
  EXPECT_EQ(refusal([&] { graph_.set_guess(NodeId::world(), Sim3()); }), "node world: it is fixed");
  EXPECT_EQ(graph_.nodes().size(), 2u);
}

TEST_F(MapGraphInput, RefusesToWithdrawWhatIsNotThere) {
  EXPECT_EQ(refusal([&] { graph_.withdraw(5); }), "constraint 5: there is none with this id");
  graph_.withdraw(0);
  EXPECT_EQ(refusal([&] { graph_.withdraw(0); }), "constraint 0: there is none with this id");
}

TEST(NodeId, IsOrderedAndPrintable) {
  EXPECT_LT(NodeId::world(), NodeId::epoch(0, 0));
  EXPECT_LT(NodeId::epoch(0, 1), NodeId::epoch(1, 0));
  EXPECT_LT(NodeId::epoch(9, 9), NodeId::keyframe(0));
  EXPECT_EQ(NodeId::keyframe(3), NodeId::keyframe(3));
  EXPECT_NE(NodeId::keyframe(3), NodeId::keyframe(4));
  std::ostringstream out;
  out << NodeId::world() << ", " << NodeId::epoch(1, 2) << ", " << NodeId::keyframe(3);
  EXPECT_EQ(out.str(), "world, epoch 1/2, keyframe 3");
}

}  // namespace
}  // namespace edgevo
