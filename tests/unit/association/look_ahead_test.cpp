#include "edgevo/association/look_ahead.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plane_scene.h"

namespace edgevo {
namespace {

// What it asks for is what an association is going to read: the edge nearest to each point, where there is
// one.
TEST(LookAhead, AsksForTheEdgesThatAreNear) {
  const test::PlaneScene scene;
  const auto frame = PyramidBuilder(scene.camera, EdgeParams())
                         .build(test::slanted_step(320, 240, {160, 120}, Eigen::Vector2d::UnitX(), 60, 180));
  const AssociationParams params;
  LookAhead look_ahead(params);
  int near = 0, added = 0;
  for (int y = 8; y < 240; y += 16)
    for (int x = 8; x < 320; x += 160) {
      near += frame->finest().field.nearest(float(x), float(y)) >= 0;
      look_ahead.add(*frame, {x, y});
      ++added;
    }
  ASSERT_LE(added, LookAhead::kAtOnce);
  ASSERT_GT(near, 0);
  ASSERT_LT(near, added);
  EXPECT_EQ(look_ahead.waiting(), added);
  EXPECT_EQ(look_ahead.run(), near);
  EXPECT_EQ(look_ahead.waiting(), 0);
  EXPECT_EQ(look_ahead.run(), 0) << "what was asked for is forgotten";
}

// Never more than it holds, and nothing beyond an image, which an address sanitizer would see it read.
TEST(LookAhead, TakesMorePlacesThanItHoldsAnywhere) {
  const test::PlaneScene scene;
  const auto frame = scene.pyramid(SE3());
  const auto blank =
      PyramidBuilder(scene.camera, EdgeParams()).build(test::make_image(320, 240, [](double, double) {
        return 90;
      }));
  const AssociationParams params;
  LookAhead look_ahead(params);
  int added = 0;
  for (double y : {-1e9, -3.0, 0.0, 0.4, 120.0, 239.0, 239.4, 1e9})
    for (double x : {-1e9, -3.0, 0.0, 0.4, 160.0, 319.0, 319.4, 1e9, std::nan("")}) {
      look_ahead.add(*frame, {x, y});
      look_ahead.add(*blank, {x, y});
      added += 2;
      EXPECT_EQ(look_ahead.waiting(), (added - 1) % LookAhead::kAtOnce + 1);
    }
  look_ahead.run();
  EXPECT_EQ(look_ahead.waiting(), 0);
  for (int i = 0; i < 10; ++i) look_ahead.add(*blank, {160, 120});
  EXPECT_EQ(look_ahead.run(), 0) << "a blank image has no edges";
}

}  // namespace
}  // namespace edgevo
