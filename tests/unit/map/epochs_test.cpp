// SPDX-License-Identifier: BSD-3-Clause
// Where the epochs of a run lie: a drive along z whose unit changes within a doubt.
#include "edgevo/map/epochs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace edgevo {
namespace {

// Keyframes one unit apart, every fourth frame; those from `kLost` to `kFound` are doubtful.
constexpr int kLost = 10, kFound = 20, kOfDrive = 30, kFramesApart = 4;

// A drive in a map whose unit becomes `collapse` times longer within the doubt, so that lengths measure less.
class DoubtfulDrive {
 public:
  explicit DoubtfulDrive(double collapse) : collapse_(collapse) {
    double z = 0;
    for (int id = 0; id < kOfDrive; ++id) {
      keyframes_.push_back({id, 0, kFramesApart * id, SE3(Eigen::Quaterniond::Identity(), {0, 0, z})});
      z += std::pow(collapse_, -0.5 * (progress(id) + progress(id + 1)));
    }
  }
  // Of the change of unit, at a keyframe.
  static double progress(int id) { return std::clamp(double(id - kLost) / (kFound - kLost), 0.0, 1.0); }
  RunSoFar run() const {
    return {[this](int id) { return id < kOfDrive ? std::optional(keyframes_[size_t(id)]) : std::nullopt; },
            [this](int, int first, int last) {
              return std::vector<KeyframeInMap>(keyframes_.begin() + first, keyframes_.begin() + last + 1);
            },
            [](int, int) { return std::optional<Matrix6d>(); },
            [](int frame, int later) { return 0.9 * (later - frame); }};
  }
  // What features of a keyframe before and one after the doubt show: their true motion.
  ConstraintAdded link(int id, int from, int to, double scale_error, double sigma) const {
    ConstraintAdded added;
    added.id = id;
    Constraint& c = added.constraint;
    c.from = NodeId::keyframe(from), c.to = NodeId::keyframe(to);
    c.T_from_to = {collapse_ * scale_error, SE3(Eigen::Quaterniond::Identity(), {0, 0, double(to - from)})};
    c.kind = ConstraintKind::kFeatures;
    c.covariance.diagonal() << 1e-2, 1e-2, 1e-2, 1e-4, 1e-4, 1e-4, sigma * sigma;
    return added;
  }

 private:
  double collapse_;
  std::vector<KeyframeInMap> keyframes_;
};

Epochs two_epochs() {
  Epochs epochs;
  epochs.begin_segment({}, {});
  epochs.begin_epoch({0, kLost, kFound});
  return epochs;
}

double z_of(const PlacedEpochs& placed, const DoubtfulDrive& drive, int id) {
  return placed.T_world_map(0, id).apply(drive.run().keyframe(id)->T_map_cam).translation().z();
}

TEST(Epochs, WithoutAnythingFoundAllStaysWhereItIs) {
  const DoubtfulDrive drive(2);
  const PlacedEpochs placed = two_epochs().solve(drive.run());
  ASSERT_EQ(placed.epochs.size(), 2u);
  for (int id = 0; id < kOfDrive; ++id) EXPECT_NEAR(placed.T_world_map(0, id).scale, 1, 1e-12);
  EXPECT_EQ(placed.epochs[0].scale_sigma, 0);
  EXPECT_GT(placed.epochs[1].scale_sigma, 0.5) << "the unit may have changed unseen";
}

// A turn that carried the unit to a tenth, in which nothing else was doubtful: so much is known of it.
TEST(Epochs, ATurnKeepsTheUnitToWhatItWasCarriedTo) {
  Epochs epochs;
  epochs.begin_segment({}, {});
  epochs.begin_epoch({0, kLost, kFound, 0.1, false});
  const DoubtfulDrive drive(1.2);
  EXPECT_NEAR(epochs.solve(drive.run()).epochs[1].scale_sigma, 0.1, 0.001);
  epochs.add(drive.link(0, kLost - 2, kFound + 1, 1, 0.1));
  const EpochPlace halfway = epochs.solve(drive.run()).epochs[1];
  EXPECT_NEAR(std::log(halfway.T_world_map.scale), 0.5 * std::log(1.2), 0.01);
  EXPECT_NEAR(halfway.scale_sigma, 0.1 / std::sqrt(2), 0.005);
}

// Every keyframe is where it was in truth, those in the doubt, too.
TEST(Epochs, AChangeOfUnitHasACourse) {
  for (const double collapse : {0.5, 2.0, 5.0, 20.0}) {
    const DoubtfulDrive drive(collapse);
    Epochs epochs = two_epochs();
    epochs.add(drive.link(0, kLost - 2, kFound + 1, 1, 0.02));
    const PlacedEpochs placed = epochs.solve(drive.run());
    EXPECT_NEAR(std::log(placed.epochs[1].T_world_map.scale / collapse), 0, 0.01) << collapse;
    EXPECT_LT(placed.epochs[1].scale_sigma, 0.03);
    for (int id = 0; id < kOfDrive; ++id) EXPECT_NEAR(z_of(placed, drive, id), id, 0.2) << collapse;
  }
}

// Features say 1.04 +- 3 % of a unit that was kept.
TEST(Epochs, ADoubtThatWasGroundlessKeepsTheUnit) {
  const DoubtfulDrive drive(1);
  Epochs epochs = two_epochs();
  epochs.add(drive.link(0, kLost - 2, kFound + 1, 1.04, 0.03));
  const PlacedEpochs placed = epochs.solve(drive.run());
  EXPECT_NEAR(placed.epochs[1].T_world_map.scale, 1, 0.006);
  for (int id = 0; id < kOfDrive; ++id) EXPECT_NEAR(z_of(placed, drive, id), id, 0.15);
}

// Links are weighed with each other, and one that is none is taken back.
TEST(Epochs, LinksAreKept) {
  const DoubtfulDrive drive(2);
  Epochs epochs = two_epochs();
  epochs.add(drive.link(0, kLost, kFound, 1.2, 0.1));
  const double first = epochs.solve(drive.run()).epochs[1].T_world_map.scale;
  EXPECT_NEAR(first, 2.4, 0.1);
  epochs.add(drive.link(1, kLost - 1, kFound + 5, 1, 0.02));
  EXPECT_NEAR(epochs.solve(drive.run()).epochs[1].T_world_map.scale, 2, 0.03);
  epochs.withdraw(1);
  EXPECT_EQ(epochs.solve(drive.run()).epochs[1].T_world_map.scale, first);
}

// The first comparison of a young map is often surer of itself than right.
TEST(Epochs, ALinkThatTheOthersContradictIsNamed) {
  const DoubtfulDrive drive(2);
  Epochs epochs = two_epochs();
  epochs.add(drive.link(0, kLost, kFound, 0.75, 0.02));
  for (int id = 1; id < 4; ++id) epochs.add(drive.link(id, kLost - 1, kFound + id, 1, 0.03));
  const PlacedEpochs placed = epochs.solve(drive.run());
  EXPECT_NEAR(placed.epochs[1].T_world_map.scale, 2, 0.03);
  EXPECT_TRUE(placed.is_unused(0));
  EXPECT_FALSE(placed.is_unused(1));
}

// Streets repeat themselves: two views that show other places, each by itself, leave the guess.
TEST(Epochs, PlacesThatNoOtherLinkConfirmsAreMistaken) {
  const DoubtfulDrive drive(1);
  Epochs epochs = two_epochs();
  for (int id = 0; id < 2; ++id) {
    ConstraintAdded link = drive.link(id, kLost - 1, kFound + id, 1, 0.03);
    link.constraint.T_from_to.rigid = SE3(Eigen::Quaterniond::Identity(), {20.0 * id, 0, 0});
    epochs.add(link);
  }
  const PlacedEpochs placed = epochs.solve(drive.run());
  EXPECT_EQ(placed.unused, (std::vector<int>{0, 1}));
  for (int id = 0; id < kOfDrive; ++id) EXPECT_NEAR(z_of(placed, drive, id), id, 0.15);
}

// A guess by equal speed, and what features say of it.
TEST(Epochs, ANewSegmentMovesToWhereFeaturesSeeIt) {
  const DoubtfulDrive drive(1);
  Epochs epochs;
  epochs.begin_segment({}, {});
  SegmentPlaced placed;
  placed.segment = 1, placed.method = SegmentPlaced::Method::kVelocity;
  placed.T_world_map = {1.7,
                        SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY())), {1, 0, 9})};
  placed.scale_sigma = 0.5, placed.rotation_sigma = 0.3, placed.position_sigma = 6;
  epochs.begin_segment(placed, {});
  RunSoFar run = drive.run();
  run.keyframe = [inner = run.keyframe](int id) {
    std::optional<KeyframeInMap> k = inner(id);
    if (k && id >= kFound)
      k->segment = 1, k->T_map_cam = SE3(Eigen::Quaterniond::Identity(), {0, 0, 0.5 * (id - kFound)});
    return k;
  };
  EXPECT_EQ(epochs.solve(run).epochs[1].T_world_map.scale, 1.7) << "as it was announced";
  ConstraintAdded link = drive.link(0, kLost, kFound, 1, 0.02);
  link.constraint.T_from_to.scale = 2;
  epochs.add(link);
  const EpochPlace found = epochs.solve(run).epochs[1];
  EXPECT_NEAR(found.T_world_map.scale, 2, 0.02);
  EXPECT_LT((found.T_world_map.rigid.translation() - Eigen::Vector3d(0, 0, kFound)).norm(), 0.1);
  EXPECT_LT(found.T_world_map.rigid.angle(), 0.01);
}

// A program that recognises places may know all of the motion, or nothing of the scale.
TEST(Epochs, ExactAndUnknownScalesAreTaken) {
  const DoubtfulDrive drive(1);
  for (const double variance : {0.0, std::numeric_limits<double>::infinity()}) {
    Epochs epochs = two_epochs();
    for (int id = 0; id < 2; ++id) {
      ConstraintAdded link = drive.link(id, kLost - 1, kFound + id, 1, 1);
      link.constraint.covariance(6, 6) = variance;
      EXPECT_NO_THROW(check_constraint(link.constraint));
      epochs.add(link);
    }
    const PlacedEpochs placed = epochs.solve(drive.run());
    EXPECT_TRUE(placed.unused.empty());
    EXPECT_NEAR(placed.epochs[1].T_world_map.scale, 1, 1e-6);
    for (int id = 0; id < kOfDrive; ++id) EXPECT_NEAR(z_of(placed, drive, id), id, 0.15) << variance;
  }
}

// From a log that was cut off or damaged.
TEST(Epochs, WhatDoesNotFitIsIgnored) {
  const DoubtfulDrive drive(2);
  Epochs epochs = two_epochs();
  epochs.begin_epoch({3, 1, 2});
  epochs.begin_epoch({0, kLost, kFound});
  epochs.add(drive.link(0, 2, 500, 1, 0.02));
  EXPECT_EQ(epochs.solve(drive.run()).epochs.size(), 2u);
  EXPECT_EQ(epochs.solve(drive.run()).epochs[1].T_world_map.scale, 1);
}

}  // namespace
}  // namespace edgevo
