// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/prefetcher.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plane_scene.h"

namespace edgevo {
namespace {

// It prefetches what an association will read: the edge nearest to each point, if there is one.
TEST(Prefetcher, PrefetchesTheEdgesNearby) {
  const test::PlaneScene scene;
  const auto frame = PyramidBuilder(scene.camera, EdgeParams())
                         .build(test::slanted_step(320, 240, {160, 120}, Eigen::Vector2d::UnitX(), 60, 180));
  const AssociationParams params;
  Prefetcher prefetcher(params);
  int near = 0, added = 0;
  for (int y = 8; y < 240; y += 16)
    for (int x = 8; x < 320; x += 160) {
      near += frame->finest().field.nearest(float(x), float(y)) >= 0;
      prefetcher.add(*frame, {x, y});
      ++added;
    }
  ASSERT_LE(added, Prefetcher::kAtOnce);
  ASSERT_GT(near, 0);
  ASSERT_LT(near, added);
  EXPECT_EQ(prefetcher.waiting(), added);
  EXPECT_EQ(prefetcher.run(), near);
  EXPECT_EQ(prefetcher.waiting(), 0);
  EXPECT_EQ(prefetcher.run(), 0) << "handled points are forgotten";
}

// More points than slots, anywhere: it must not read outside an image, which an address sanitizer would
// report.
TEST(Prefetcher, AcceptsMorePointsThanItHasSlots) {
  const test::PlaneScene scene;
  const auto frame = scene.pyramid(SE3());
  const auto blank =
      PyramidBuilder(scene.camera, EdgeParams()).build(test::make_image(320, 240, [](double, double) {
        return 90;
      }));
  const AssociationParams params;
  Prefetcher prefetcher(params);
  int added = 0;
  for (double y : {-1e9, -3.0, 0.0, 0.4, 120.0, 239.0, 239.4, 1e9})
    for (double x : {-1e9, -3.0, 0.0, 0.4, 160.0, 319.0, 319.4, 1e9, std::nan("")}) {
      prefetcher.add(*frame, {x, y});
      prefetcher.add(*blank, {x, y});
      added += 2;
      EXPECT_EQ(prefetcher.waiting(), (added - 1) % Prefetcher::kAtOnce + 1);
    }
  prefetcher.run();
  EXPECT_EQ(prefetcher.waiting(), 0);
  for (int i = 0; i < 10; ++i) prefetcher.add(*blank, {160, 120});
  EXPECT_EQ(prefetcher.run(), 0) << "a blank image has no edges";
}

}  // namespace
}  // namespace edgevo
