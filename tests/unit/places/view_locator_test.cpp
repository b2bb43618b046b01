// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/view_locator.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "edgevo/core/angle.h"
#include "rendered_view.h"

namespace edgevo {
namespace {

using test::street;

constexpr double kUnit = 2;  // of the map, in units a metre

// The map that a drive down the street has kept: a keyframe every other frame.
std::shared_ptr<const PlaceStore> drive() {
  auto store = std::make_shared<PlaceStore>(street().pinhole());
  for (int frame = 0; frame < 40; frame += 2) {
    const auto pyramid = street().pyramid(frame);
    auto record = std::make_shared<KeyframeRecord>();
    record->frame_index = frame;
    const SE3 pose = street().T_world_cam(frame);
    record->T_world_cam = SE3(pose.rotation(), kUnit * pose.translation());
    record->points = street().edge_points(*pyramid, frame);
    for (EdgePoint& p : record->points) p.idepth /= float(kUnit), p.idepth_sigma /= float(kUnit);
    store->add(
        {frame, 0, record, std::make_shared<const RememberedView>(remember_view(*pyramid)), std::nullopt});
  }
  return store;
}

std::shared_ptr<const PlaceStore> map_of_street() {
  static const std::shared_ptr<const PlaceStore> map = drive();
  return map;
}

std::vector<bool> located(const test::ViewRenderer& scene, std::initializer_list<int> frames) {
  ViewLocator locator(map_of_street());
  std::vector<bool> found;
  for (const int frame : frames) found.push_back(locator.locate(*scene.pyramid(frame)).has_value());
  return found;
}

TEST(ViewLocator, FindsTheThirdImageInARow) {
  ViewLocator locator(map_of_street());
  EXPECT_FALSE(locator.locate(*street().pyramid(11)));
  EXPECT_FALSE(locator.locate(*street().pyramid(12)));
  const std::optional<LocatedPose> found = locator.locate(*street().pyramid(13));
  ASSERT_TRUE(found);
  const SE3 truth = street().T_world_cam(13);
  EXPECT_LT((found->T_world_cam.translation() - kUnit * truth.translation()).norm(),
            0.02 * found->median_depth);
  EXPECT_LT((found->T_world_cam.inverse() * truth).log().tail<3>().norm(), rad(0.3));
  EXPECT_GT(found->median_depth, 2 * kUnit);
}

// From a pure rotation, or a camera that stands, no map can be made.
TEST(ViewLocator, NeedsNoMotion) {
  EXPECT_EQ(located(street(), {21, 21, 21, 21}), (std::vector<bool>{false, false, true, true}));
}

TEST(ViewLocator, DoesNotBelieveImagesThatAreApart) {
  EXPECT_EQ(located(street(), {5, 20, 35}), (std::vector<bool>{false, false, false}));
}

TEST(ViewLocator, FindsNothingElsewhere) {
  const test::ViewRenderer other("street", 9);
  EXPECT_EQ(located(other, {11, 12, 13, 14}), (std::vector<bool>(4, false)));
}

}  // namespace
}  // namespace edgevo
