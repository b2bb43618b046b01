// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/recordings/static_frames.h"

#include <gtest/gtest.h>

namespace edgevo::test {
namespace {

TransformMessage link(const std::string& parent, const std::string& child, double x) {
  return {{{}, parent}, child, SE3(Eigen::Quaterniond::Identity(), {x, 0, 0})};
}

TEST(StaticFrames, FollowTheTreeUpAndDown) {
  StaticFrames frames;
  frames.add(link("base_footprint", "base_link", 1));
  frames.add(link("base_link", "mast", 2));
  frames.add(link("mast", "cam", 4));
  frames.add(link("base_link", "gps", 8));
  EXPECT_EQ(frames.vehicle_frame("cam"), "base_link");
  EXPECT_EQ(frames.between("base_link", "cam")->translation().x(), 6);
  EXPECT_EQ(frames.between("gps", "cam")->translation().x(), -2);
  EXPECT_EQ(frames.between("cam", "cam")->translation().x(), 0);
  EXPECT_FALSE(frames.between("base_link", "other"));
  EXPECT_EQ(frames.vehicle_frame("other"), "");
}

TEST(StaticFrames, WithoutBaseLinkTheRootIsTheVehicle) {
  StaticFrames frames;
  frames.add(link("body", "mast", 2));
  frames.add(link("mast", "cam", 4));
  EXPECT_EQ(frames.vehicle_frame("cam"), "body");
}

TEST(StaticFrames, ACircleEnds) {
  StaticFrames frames;
  frames.add(link("a", "b", 1));
  frames.add(link("b", "a", 1));
  frames.between("a", "b");
  frames.vehicle_frame("a");
  frames.add(link("c", "c", 1));
  EXPECT_EQ(frames.vehicle_frame("c"), "");
}

}  // namespace
}  // namespace edgevo::test
