// SPDX-License-Identifier: BSD-3-Clause
// The scale of a run from its events.
#include "edgevo/scale/run_scaling.h"

#include <gtest/gtest.h>

#include <limits>

#include "drive_over_ground.h"
#include "edgevo/core/record_units.h"
#include "edgevo/map/run_builder.h"

namespace edgevo {
namespace {

using test::drive_over_ground;
using test::GroundDrive;
using test::MadeRun;
using test::unit_at;

// The unit of the map drifts along the path until, after this frame, the past is brought to the unit of the
// newest keyframe.
constexpr int kMovedAfter = 240;
constexpr int kWindow = 16;     // keyframes: every second frame is one
constexpr int kFirstPose = 10;  // the frames before have none at first
constexpr double kWorldPerMap = 0.5;

GroundDrive drifting() {
  GroundDrive drive;
  drive.metres_per_unit_begin = 1.8, drive.metres_per_unit_end = 2.3;
  return drive;
}

// A keyframe of the drive, number k, in its segment's map.
KeyframeRecord in_map(KeyframeRecord keyframe) {
  const Sim3 T_map_world = Sim3{kWorldPerMap, SE3()}.inverse();
  keyframe.T_world_cam = T_map_world.apply(keyframe.T_world_cam);
  multiply_depths(T_map_world.scale, &keyframe);
  return keyframe;
}

class ScalingOfADrive : public ::testing::Test {
 protected:
  std::unique_ptr<RunScaling> new_scaling() const {
    const ScaleSource height{ScaleSource::Kind::kCameraHeight, 1.65, "camera_height=1.65"};
    auto scaling =
        std::make_unique<RunScaling>(height, VehicleTracks(), made_.run.pinhole, std::nullopt, ScaleParams());
    scaling->apply(SegmentPlaced{0, {kWorldPerMap, SE3()}, {}});
    return scaling;
  }

  void drive_to(int end) {
    for (; next_ < end; ++next_) {
      add_frame(made_.run.frames[size_t(next_)]);
      if (next_ % 2 == 0 && next_ / 2 >= kWindow) marginalise(next_ / 2 - kWindow);
    }
  }
  void add_frame(FrameRecord frame) {
    frame.segment = frame.index >= segment_begin_;
    if (frame.index < kFirstPose) {
      FrameRecord without = frame;
      without.T_world_cam_live = std::nullopt;
      scaling_->apply(FrameAnchored{without, std::nullopt});
      if (!comes_twice_) return;
    }
    if (comes_twice_) scaling_->apply(FrameAnchored{frame, FrameAnchor()});
    scaling_->apply(FrameAnchored{frame, FrameAnchor()});
  }
  void marginalise(int k) {
    KeyframeRecord keyframe = in_map(made_.run.keyframes[size_t(k)]);
    keyframe.segment = keyframe.frame_index >= segment_begin_;
    scaling_->apply(KeyframeMarginalised{k, std::make_shared<const KeyframeRecord>(keyframe), {}});
  }
  // The past takes the unit of the newest keyframe.
  void move() {
    MapMoved moved;
    for (int k = 0; k < next_ / 2; ++k) {
      KeyframeMove m;
      m.id = k;
      m.scale_ratio = unit_at(drive_, 2 * k) / unit_at(drive_, next_);
      moved.keyframes.push_back(m);
    }
    scaling_->apply(moved);
  }
  // Factors as they were known frame by frame.
  std::vector<double> live_factors() const {
    edgevo::Run run = made_.run;
    scaling_->convert(&run);
    EXPECT_EQ(run.scale.problem, "");
    std::vector<double> factors;
    for (const FrameScale& f : run.scale.frames) factors.push_back(f.live_factor);
    return factors;
  }

  const GroundDrive drive_ = drifting();
  const MadeRun made_ = drive_over_ground(drive_);
  std::unique_ptr<RunScaling> scaling_ = new_scaling();
  bool comes_twice_ = false;
  int segment_begin_ = std::numeric_limits<int>::max();  // first frame of the second segment
  int next_ = 0;
};

TEST_F(ScalingOfADrive, FollowsAPastThatMovesWithoutTheCamera) {
  drive_to(kMovedAfter);
  move();
  drive_to(kMovedAfter + 1);
  const std::vector<double> factors = live_factors();
  const double unit = unit_at(drive_, kMovedAfter);
  EXPECT_LT(factors[kMovedAfter - 1], 0.97 * unit) << "measured over an interval behind";
  EXPECT_NEAR(factors[kMovedAfter], unit, 0.01 * unit) << "of keyframes that have the newest unit now";
}

TEST_F(ScalingOfADrive, AMoveOfAnotherSegmentChangesNothing) {
  drive_to(kMovedAfter);
  MapMoved moved;
  moved.segment = 1;
  moved.keyframes.resize(1);
  moved.keyframes[0].id = kMovedAfter / 2 - kWindow - 1;
  moved.keyframes[0].scale_ratio = 5;
  scaling_->apply(moved);
  drive_to(kMovedAfter + 1);
  const std::vector<double> factors = live_factors();
  EXPECT_EQ(factors[kMovedAfter], factors[kMovedAfter - 1]);
}

// With a pose that a bootstrap found for it later, or with other notes.
TEST_F(ScalingOfADrive, AFrameThatComesAgainCountsOnce) {
  drive_to(kMovedAfter);
  const std::vector<double> once = live_factors();
  scaling_ = new_scaling();
  next_ = 0;
  comes_twice_ = true;
  drive_to(kMovedAfter);
  for (const int i : {0, 40, kMovedAfter - 1})
    scaling_->apply(FrameAnchored{made_.run.frames[size_t(i)], {}});
  EXPECT_EQ(live_factors(), once);
}

// A map that is still tracked is replaced by another one, at the frame that was in both.
TEST_F(ScalingOfADrive, ASegmentBeginsWithTheFrameThatComesAgainInIt) {
  const auto drive_second = [&](bool is_in_both) {
    scaling_ = new_scaling();
    next_ = 0;
    drive_to(segment_begin_ = 100);
    if (is_in_both) scaling_->apply(FrameAnchored{made_.run.frames[100], FrameAnchor()});
    scaling_->apply(SegmentPlaced{1, {kWorldPerMap, SE3()}, {}});
    drive_to(kMovedAfter);
    return live_factors();
  };
  EXPECT_EQ(drive_second(true), drive_second(false));
}

}  // namespace
}  // namespace edgevo
