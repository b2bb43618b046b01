// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/camera_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/camera_examples.h"

namespace edgevo {
namespace {

TEST(CameraDifference, IsZeroForTheSameCamera) {
  for (const test::CameraExample& example : test::camera_examples())
    EXPECT_LT(largest_difference_px(example.camera, example.camera), 1e-6) << example.name;
}

TEST(CameraDifference, IsThatOfThePixels) {
  const Camera camera({500, 500, 320, 240, 640, 480}), moved({500, 500, 322, 240, 640, 480});
  EXPECT_NEAR(largest_difference_px(camera, moved), 2, 1e-9);
  const Camera longer({510, 500, 320, 240, 640, 480});
  EXPECT_NEAR(largest_difference_px(camera, longer), 320 * 0.02, 1e-9);
}

TEST(CameraDifference, IsInfiniteWhereOneShowsNothing) {
  const Camera camera({150, 150, 320, 240, 640, 480});
  const Camera folded({150, 150, 320, 240, 640, 480}, {-0.25, 0, 0, 0, 0});
  EXPECT_TRUE(std::isinf(largest_difference_px(camera, folded)));
}

}  // namespace
}  // namespace edgevo
