// SPDX-License-Identifier: BSD-3-Clause
#include "load_control.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

constexpr double kInTime = 0.001, kLate = 0.03, kVeryLate = 0.07;

Shedding after(LoadControl* control, int frames, double late_s) {
  Shedding shedding{};
  for (int i = 0; i < frames; ++i) shedding = control->next(late_s);
  return shedding;
}

TEST(LoadControl, ShedsNothingInTime) {
  LoadControl control;
  EXPECT_EQ(after(&control, 1000, kInTime), Shedding::kNothing);
}

TEST(LoadControl, OneOrTwoLateFramesAreNothing) {
  LoadControl control;
  EXPECT_EQ(after(&control, 2, kLate), Shedding::kNothing);
  after(&control, 1, kInTime);
  EXPECT_EQ(after(&control, 2, kLate), Shedding::kNothing);
}

TEST(LoadControl, ShedsLinesThenDepthsThenPoints) {
  LoadControl control;
  EXPECT_EQ(after(&control, 3, kLate), Shedding::kLines);
  EXPECT_EQ(after(&control, 3, kLate), Shedding::kDepths);
  EXPECT_EQ(after(&control, 3, kLate), Shedding::kPoints);
  EXPECT_EQ(after(&control, 3, kLate), Shedding::kPoints) << "there is no more";
}

TEST(LoadControl, ShedsAtOnceWhereFramesAreVeryLate) {
  LoadControl control;
  EXPECT_EQ(after(&control, 1, kVeryLate), Shedding::kLines);
  EXPECT_EQ(after(&control, 2, kVeryLate), Shedding::kPoints);
}

TEST(LoadControl, TakesTheWorkUpAgainStepByStep) {
  LoadControl control;
  after(&control, 3, kVeryLate);
  EXPECT_EQ(after(&control, 59, kInTime), Shedding::kPoints);
  EXPECT_EQ(after(&control, 1, kInTime), Shedding::kDepths);
  EXPECT_EQ(after(&control, 120, kInTime), Shedding::kNothing);
}

TEST(LoadControl, DropsOnlyFramesThatAreTooLate) {
  EXPECT_FALSE(LoadControl::drops(kVeryLate));
  EXPECT_TRUE(LoadControl::drops(0.09));
}

}  // namespace
}  // namespace edgevo
