// SPDX-License-Identifier: BSD-3-Clause
// A drive round a block whose heading and unit drift, and a place that is seen again at its end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/map/epochs.h"

namespace edgevo {
namespace {

constexpr int kRound = 200;         // keyframes, one unit apart
constexpr double kUnitDrift = 0.1;  // lengths of the map become shorter by it
constexpr double kTurnDrift = rad(10);

class Round {
 public:
  Round() {
    SE3 T_world_cam, T_map_cam;
    for (int id = 0; id < kRound; ++id) {
      truth_.push_back(T_world_cam);
      keyframes_.push_back({id, 0, 4 * id, T_map_cam});
      T_world_cam = T_world_cam * step(2 * EIGEN_PI / kRound, 1);
      T_map_cam = T_map_cam * step((2 * EIGEN_PI + kTurnDrift) / kRound, unit(id));
    }
  }
  RunSoFar run() const {
    return {[this](int id) { return id < kRound ? std::optional(keyframes_[size_t(id)]) : std::nullopt; },
            [this](int, int first, int last) {
              return std::vector<KeyframeInMap>(keyframes_.begin() + first, keyframes_.begin() + last + 1);
            },
            [](int, int) { return std::optional<Matrix6d>(1e-6 * Matrix6d::Identity()); },
            [](int, int) { return 0.0; }};
  }
  // What is seen of one keyframe from another, 1 % sure of the distance: truly, or turned round.
  ConstraintAdded seen_again(int id, int from, int to, bool is_true = true) const {
    ConstraintAdded added;
    added.id = id;
    Constraint& c = added.constraint;
    c.from = NodeId::keyframe(from), c.to = NodeId::keyframe(to);
    c.kind = ConstraintKind::kPlace;
    const SE3 T = truth_[size_t(from)].inverse() * truth_[size_t(to)];
    c.T_from_to = {unit(from) / unit(to), SE3(T.rotation(), unit(from) * T.translation())};
    if (!is_true) c.T_from_to.rigid = SE3(T.rotation(), {30, 0, -30});
    c.covariance.diagonal() << 1e-2, 1e-2, 1e-2, 1e-4, 1e-4, 1e-4, 4e-4;
    return added;
  }
  PlacedEpochs place(const std::vector<ConstraintAdded>& found, int later_epoch_first = -1) const {
    Epochs epochs;
    epochs.begin_segment({}, {});
    if (later_epoch_first > 0)
      epochs.begin_epoch({0, std::min(kRound, later_epoch_first) - 1, later_epoch_first});
    for (const ConstraintAdded& c : found) epochs.add(c);
    return epochs.solve_keyframes(run(), keyframes_);
  }
  // Where a keyframe lies in a map that was kept, at T_kept_world to the world of the truth.
  ConstraintAdded found_in_map(int id, int keyframe, const Sim3& T_kept_world) const {
    ConstraintAdded added = seen_again(id, keyframe, keyframe);
    added.constraint.from = NodeId::world();
    added.constraint.T_from_to =
        T_kept_world * Sim3{1, truth_[size_t(keyframe)]} * Sim3{1 / unit(keyframe), SE3()};
    const Matrix7d A = Sim3{1, added.constraint.T_from_to.rigid}.adjoint();
    added.constraint.covariance = A * added.constraint.covariance * A.transpose();
    return added;
  }
  double largest_error(const PlacedEpochs& placed) const {
    double largest = 0;
    for (const KeyframeInMap& k : keyframes_) {
      const SE3 T = placed.T_world_map(0, k.id).apply(k.T_map_cam);
      largest = std::max(largest, (T.translation() - truth_[size_t(k.id)].translation()).norm());
    }
    return largest;
  }
  static double unit(int id) { return 1 - kUnitDrift * id / kRound; }

 private:
  static SE3 step(double turn, double length) {
    return SE3(Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY())), {0, 0, length});
  }
  std::vector<SE3> truth_;
  std::vector<KeyframeInMap> keyframes_;
};

TEST(KeyframeGraph, APlaceSeenAgainMovesThePath) {
  const Round round;
  const double before = round.largest_error(round.place({}));
  EXPECT_GT(before, 5) << "of a path of 200";
  const PlacedEpochs placed = round.place({round.seen_again(0, 2, kRound - 1)});
  EXPECT_TRUE(placed.unused.empty());
  EXPECT_LT(round.largest_error(placed), 2);
  EXPECT_NEAR(placed.T_world_map(0, kRound - 1).scale, 1 / Round::unit(kRound - 1), 0.03);
  EXPECT_EQ(placed.epochs.back().T_world_map.scale, placed.T_world_map(0, kRound - 1).scale);
  EXPECT_NEAR(placed.T_world_map(0, 0).scale, 1, 1e-9) << "the beginning stays";
}

TEST(KeyframeGraph, APlaceThatIsMistakenIsNamed) {
  const Round round;
  const PlacedEpochs placed =
      round.place({round.seen_again(0, 2, kRound - 1), round.seen_again(1, 40, 150, false),
                   round.seen_again(2, 1, kRound - 2)});
  EXPECT_EQ(placed.unused, (std::vector<int>{1}));
  EXPECT_LT(round.largest_error(placed), 2);
}

// Of a covariance that is merely large, a mistaken place that is far beyond it still bends the map, until the
// right ones seem to be mistaken.
TEST(KeyframeGraph, ManyMistakenPlacesDoNotBendThePath) {
  const Round round;
  std::vector<ConstraintAdded> right;
  for (int i = 0; i < 20; ++i) right.push_back(round.seen_again(i, i, kRound - 20 + i));
  std::vector<ConstraintAdded> all = right;
  for (int i = 0; i < 10; ++i) {
    all.push_back(right[size_t(2 * i)]);
    all.back().id = 20 + i;
    // What looks like the beginning is a quarter to half of the way round.
    all.back().constraint.from = NodeId::keyframe(50 + 5 * i);
  }
  const PlacedEpochs placed = round.place(all);
  EXPECT_EQ(placed.unused, (std::vector<int>{20, 21, 22, 23, 24, 25, 26, 27, 28, 29}));
  EXPECT_NEAR(round.largest_error(placed), round.largest_error(round.place(right)), 0.05);
}

TEST(KeyframeGraph, AKeptMapGivesItsFrameAndUnit) {
  const Round round;
  const Sim3 T_kept_world{
      2.5, SE3(Eigen::Quaterniond(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitY())), {7, 1, -3})};
  std::vector<ConstraintAdded> found;
  for (const int keyframe : {20, 21, 22, 100, 101, 102, 180, 181, 182})
    found.push_back(round.found_in_map(keyframe, keyframe, T_kept_world));
  PlacedEpochs placed = round.place(found);
  EXPECT_TRUE(placed.unused.empty());
  for (auto& [id, T] : placed.own) T = T_kept_world.inverse() * T;
  EXPECT_LT(round.largest_error(placed), 1);
}

TEST(KeyframeGraph, AKeptMapThatIsContradictedGivesNothing) {
  const Round round;
  const Sim3 far{3, SE3(Eigen::Quaterniond::Identity(), {500, 0, 0})};
  // Each of the three says something else.
  const std::vector<ConstraintAdded> found = {
      round.found_in_map(0, 20, far),
      round.found_in_map(1, 21, far * Sim3{0.2, SE3(Eigen::Quaterniond::Identity(), {900, 0, 0})}),
      round.found_in_map(2, 22, far * Sim3{4, SE3(Eigen::Quaterniond::Identity(), {0, 0, 900})})};
  const PlacedEpochs placed = round.place(found);
  if (placed.unused.size() == found.size()) {
    EXPECT_NEAR(placed.T_world_map(0, 0).scale, 1, 1e-6);
  }
  EXPECT_GE(placed.unused.size(), 2U);
}

// Taken for rigid, the two would contradict most of the places.
TEST(KeyframeGraph, PlacesOfTwoEpochsMoveTheKeyframesOfBoth) {
  const Round round;
  std::vector<ConstraintAdded> found;
  for (int i = 0; i < 10; ++i) found.push_back(round.seen_again(i, 8 * i, kRound - 1 - 8 * i));
  const PlacedEpochs placed = round.place(found, kRound / 2);
  ASSERT_EQ(placed.epochs.size(), 2U);
  EXPECT_TRUE(placed.unused.empty());
  EXPECT_LT(round.largest_error(placed), 2);
}

// It has no keyframe of its own yet that has left the window.
TEST(KeyframeGraph, AnEpochThatHasJustBegunMovesWithTheNewestKeyframe) {
  const Round round;
  const PlacedEpochs placed = round.place({round.seen_again(0, 2, kRound - 1)}, kRound + 3);
  ASSERT_EQ(placed.epochs.size(), 2U);
  const Sim3& newest = placed.T_world_map(0, kRound - 1);
  const Sim3& after = placed.T_world_map(0, kRound + 5);
  EXPECT_NEAR(after.scale, newest.scale, 1e-9);
  EXPECT_LT((after.rigid.translation() - newest.rigid.translation()).norm(), 1e-6);
}

// Two exact scales that contradict each other are two measurements, not an error.
TEST(KeyframeGraph, ExactScalesMayContradictEachOther) {
  const Round round;
  std::vector<ConstraintAdded> found;
  for (int id = 0; id < 2; ++id) {
    found.push_back(round.seen_again(id, 2, kRound - 1));
    found.back().constraint.T_from_to.scale *= 1 + 0.05 * id;
    found.back().constraint.covariance(6, 6) = 0;
  }
  EXPECT_LT(round.largest_error(round.place(found)), 6);
}

TEST(KeyframeGraph, WithoutSuchAPlaceNothingMoves) {
  const Round round;
  ConstraintAdded unit_alone = round.seen_again(0, 2, kRound - 1);
  unit_alone.constraint.covariance = covariance_of_scale(0.02);
  EXPECT_TRUE(round.place({}).own.empty());
  EXPECT_TRUE(round.place({unit_alone}).own.empty());
}

}  // namespace
}  // namespace edgevo
