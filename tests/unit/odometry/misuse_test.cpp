// SPDX-License-Identifier: BSD-3-Clause
// What a program may do wrong with the odometry is refused by an exception, and what was computed before is
// kept. With sanitizers these tests find reads beyond an image and after the end of a run.
#include <gtest/gtest.h>

#include <stdexcept>

#include "edgevo/core/error.h"
#include "edgevo/odometry/odometry.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::sweep_frame;

class Misuse : public ::testing::TestWithParam<bool> {
 protected:
  Misuse() {
    OdometryOptions options;
    options.realtime = GetParam();
    odometry_ = std::make_unique<Odometry>(test::sweep_camera(), OdometryParams(), options);
  }
  void process(int begin, int end) {
    for (int k = begin; k < end; ++k) odometry_->process(sweep_frame(k));
  }
  void expect_frames(size_t frames) { EXPECT_EQ(odometry_->finish().frames.size(), frames); }

  std::unique_ptr<Odometry> odometry_;
};

INSTANTIATE_TEST_SUITE_P(Odometry, Misuse, ::testing::Bool());

TEST_P(Misuse, NothingIsAcceptedAfterTheEnd) {
  process(0, 20);
  odometry_->finish();
  EXPECT_THROW(odometry_->process(sweep_frame(20)), std::logic_error);
  EXPECT_THROW(odometry_->skip(sweep_frame(20), "late"), std::logic_error);
  EXPECT_THROW(odometry_->finish(), std::logic_error);
  EXPECT_TRUE(odometry_->frame_view().points.empty());
  EXPECT_EQ(odometry_->newest_pose().frame_index, 19);
}

TEST_P(Misuse, ViewAndPoseBeforeTheFirstFrameAreEmpty) {
  EXPECT_TRUE(odometry_->frame_view().points.empty());
  EXPECT_FALSE(odometry_->newest_pose().reference);
  expect_frames(0);
}

TEST_P(Misuse, AnImageWithFewerOrMorePixelsThanItsSizeIsRefused) {
  process(0, 20);
  for (const size_t pixels : {size_t(0), size_t(1000), sweep_frame(0).image.pixels.size() + 1}) {
    Frame frame = sweep_frame(20);
    frame.image.pixels.resize(pixels);
    frame.image.pixels.shrink_to_fit();
    EXPECT_THROW(odometry_->process(frame), InputError) << pixels;
  }
  process(20, 22);
  expect_frames(22);
}

TEST_P(Misuse, AnImageOfANegativeSizeIsRefused) {
  Frame frame = sweep_frame(0);
  frame.image.width = -frame.image.width;
  frame.image.height = -frame.image.height;
  EXPECT_THROW(odometry_->process(frame), InputError);
  process(0, 1);
  expect_frames(1);
}

TEST_P(Misuse, TimesMustIncrease) {
  process(0, 20);
  for (const int of : {19, 10}) {
    Frame frame = sweep_frame(20);
    frame.time = sweep_frame(of).time;
    EXPECT_THROW(odometry_->process(frame), InputError) << of;
  }
  process(20, 22);
  expect_frames(22);
}

TEST_P(Misuse, IndicesMustIncrease) {
  process(0, 20);
  for (const int index : {19, 3, -1}) {
    Frame frame = sweep_frame(20);
    frame.index = index;
    EXPECT_THROW(odometry_->process(frame), InputError) << index;
    EXPECT_THROW(odometry_->skip(frame, "twice"), InputError) << index;
  }
  process(20, 22);
  expect_frames(22);
}

// A frame whose time is wrong is skipped with that of the frame before; the next one is tracked as usual.
TEST_P(Misuse, ASkippedFrameMayHaveTheTimeOfTheOneBefore) {
  process(0, 40);
  Frame frame = sweep_frame(40);
  frame.time = sweep_frame(39).time;
  odometry_->skip(frame, "its clock stood still");
  Frame earlier = sweep_frame(41);
  earlier.time = sweep_frame(38).time;
  EXPECT_THROW(odometry_->skip(earlier, "before"), InputError);
  EXPECT_TRUE(odometry_->process(sweep_frame(41)).T_world_cam_live);
  expect_frames(42);
}

}  // namespace
}  // namespace edgevo
