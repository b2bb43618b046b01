// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/motion_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SE3 at_z(double z) { return SE3(Eigen::Quaterniond::Identity(), {0, 0, z}); }

// A camera along z; points come nearer.
class Path {
 public:
  void go(double step, int frames = 1, bool stands = false) {
    for (int i = 0; i < frames; ++i) history.add({at_z(z_ += step), at_z(-step), 1, stands});
  }
  void move_map(double by) { z_ += by; }
  MotionHistory history;

 private:
  double z_ = 0;
};

Path after_steps_of(double step, int frames) {
  Path path;
  path.go(step, frames);
  return path;
}

// ---- steps as measured ----

TEST(MotionHistory, TheLargestStepIsTenTimesTheUsualOne) {
  EXPECT_EQ(after_steps_of(0.3, 5).history.largest_step(10, 1), kInfinity) << "not known yet";
  EXPECT_NEAR(after_steps_of(0.3, 30).history.largest_step(10, 1), 3, 1e-9);
}

TEST(MotionHistory, AStepOverAGapIsTheMeanOfItsFrames) {
  MotionHistory history;
  for (int i = 0; i < 30; ++i) history.add({SE3(), at_z(-1.2), 4});
  EXPECT_NEAR(history.largest_step(10, 1), 3, 1e-9);
  EXPECT_FALSE(history.median_step());
}

TEST(MotionHistory, ACameraThatStandsStillMayStartToMove) {
  EXPECT_NEAR(after_steps_of(0, 30).history.largest_step(10, 10), 0.2, 1e-9) << "0.02 depths";
}

TEST(MotionHistory, ACameraThatWaitedMayGoOnAsItCame) {
  Path path = after_steps_of(0.3, 30);
  path.go(0, 100);
  EXPECT_NEAR(path.history.largest_step(10, 1), 3, 1e-9);
}

TEST(MotionHistory, TheTypicalStepIsThatBeforeAStandstill) {
  EXPECT_TRUE(after_steps_of(0.3, 5).history.typical_step().isZero()) << "not known yet";
  Path path = after_steps_of(0.3, 30);
  path.go(-3e-4, 30);
  EXPECT_LT((path.history.typical_step() - Eigen::Vector3d(0, 0, -0.3)).norm(), 1e-9);
}

// ---- steps in the map ----

TEST(MotionHistory, TheNewestStepIsComparedWithThoseBeforeIt) {
  Path path = after_steps_of(0.3, 30);
  path.go(0.9);
  const MotionHistory::Newest& newest = path.history.newest();
  EXPECT_NEAR(newest.step, 0.9, 1e-9);
  EXPECT_NEAR(newest.usual, 0.3, 1e-9);
  EXPECT_NEAR(newest.length, 9 * 0.3 + 0.9, 1e-9) << "of ten frames";
  EXPECT_NEAR(newest.turn_rad, 0, 1e-9);
}

// What was tracked does not change when an adjustment moves the map under the camera.
TEST(MotionHistory, WhatTheMapHasMovedIsKnownForTenFrames) {
  Path path = after_steps_of(0.3, 30);
  EXPECT_NEAR(path.history.newest().moved_by_map, 0, 1e-9);
  path.move_map(0.2);
  for (int i = 0; i < 10; ++i) {
    path.go(0.3);
    EXPECT_NEAR(path.history.newest().moved_by_map, 0.2, 1e-9) << i;
  }
  path.go(0.3);
  EXPECT_NEAR(path.history.newest().moved_by_map, 0, 1e-9);
  path.move_map(0.2);
  path.history.interrupt();
  path.go(0.3, 3);
  EXPECT_NEAR(path.history.newest().moved_by_map, 0, 1e-9) << "of the frames in a row";
}

TEST(MotionHistory, ThereIsNoStepInTheMapOverAGapOrToAnotherMap) {
  for (const bool is_new_map : {false, true}) {
    Path path = after_steps_of(0.3, 30);
    is_new_map ? path.history.begin_map() : path.history.interrupt();
    path.go(100);
    EXPECT_TRUE(std::isnan(path.history.newest().step));
    EXPECT_EQ(std::isnan(path.history.newest().usual), is_new_map) << "in another unit";
    EXPECT_EQ(path.history.newest().length, 0);
  }
}

TEST(MotionHistory, AFrameThatIsKnownToStandDoesNotCount) {
  Path path = after_steps_of(0.3, 30);
  path.go(1e-4, 60, true);
  EXPECT_NEAR(path.history.newest().usual, 0.3, 1e-9);
  EXPECT_NEAR(path.history.newest().step, 1e-4, 1e-9);
}

// ---- the unit ----

TEST(MotionHistory, ANewMapHasAnotherUnit) {
  Path path = after_steps_of(0.3, 30);
  path.history.begin_map();
  EXPECT_EQ(path.history.largest_step(10, 1), kInfinity);
  EXPECT_TRUE(path.history.typical_step().isZero());
}

}  // namespace
}  // namespace edgevo
