// SPDX-License-Identifier: BSD-3-Clause
// Whether a run is in the map that was kept: as its events say, for the epoch in use.
#include "edgevo/run_loop/kept_places.h"

#include <gtest/gtest.h>

#include "edgevo/core/error.h"
#include "unit/kept_map/made_map.h"

namespace edgevo {
namespace {

class RunInKeptMap : public ::testing::Test {
 protected:
  RunInKeptMap() {
    made_.write(path_);
    places_.emplace(path_, made_.header.pinhole, "");
  }
  void say(MapEvent event) { places_->follow({std::make_shared<const MapEvent>(std::move(event))}); }
  // The keyframe lies at a place of the kept map, and the epochs are placed by it.
  void find(int constraint, int keyframe, int segment) {
    Constraint place;
    place.from = NodeId::world(), place.to = NodeId::keyframe(keyframe);
    say(ConstraintAdded{constraint, place});
    solve(constraint, segment);
  }
  void solve(int newest_constraint, int segment) {
    EpochsPlaced placed;
    placed.segment = segment, placed.newest_constraint = newest_constraint;
    say(placed);
  }
  bool is_placed() const { return places_->is_placed(); }

  test::TempFolder temp_;
  const std::string path_ = temp_ / "map.db";
  const test::MadeMap made_;
  std::optional<KeptPlaces> places_;
};

TEST_F(RunInKeptMap, OnceAKeyframeOfItWasFoundAndSolvedFor) {
  say(KeyframeAdded{0, 0, 0});
  solve(-1, 0);
  EXPECT_FALSE(is_placed());
  find(0, 0, 0);
  EXPECT_TRUE(is_placed());
  say(ConstraintWithdrawn{0});
  solve(0, 0);
  EXPECT_FALSE(is_placed());
}

TEST_F(RunInKeptMap, AfterALossNotUntilItIsFoundAgain) {
  say(KeyframeAdded{0, 0, 0});
  find(0, 0, 0);
  say(KeyframeAdded{7, 30, 1});
  EXPECT_FALSE(is_placed());
  solve(0, 1);
  EXPECT_FALSE(is_placed()) << "that was the segment before";
  find(1, 8, 1);
  EXPECT_TRUE(is_placed());
}

TEST_F(RunInKeptMap, AfterADoubtNotUntilItIsFoundAgain) {
  say(KeyframeAdded{0, 0, 0});
  find(0, 0, 0);
  EpochBegan epoch;
  epoch.last_before = 4, epoch.first = 9;
  say(epoch);
  solve(0, 0);
  EXPECT_FALSE(is_placed()) << "its unit is another";
  find(1, 6, 0);
  EXPECT_FALSE(is_placed()) << "a keyframe in the doubt";
  find(2, 9, 0);
  EXPECT_TRUE(is_placed());
}

TEST_F(RunInKeptMap, AMapOfMetresIsRefusedToARunThatGetsItsOwn) {
  test::MadeMap metres;
  metres.run.scale_source = "odometry";
  metres.write(path_);
  EXPECT_THROW(KeptPlaces(path_, metres.header.pinhole, "--scale factor=2"), InputError);
  EXPECT_TRUE(KeptPlaces(path_, metres.header.pinhole, "").is_metric());
}

}  // namespace
}  // namespace edgevo
