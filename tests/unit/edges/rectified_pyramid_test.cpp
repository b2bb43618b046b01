// SPDX-License-Identifier: BSD-3-Clause
// Pyramids in a pinhole of another size and focal length than the camera's.
#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/edges/frame_pyramid.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

const Camera kBarrel({300, 300, 160, 120, 320, 240}, {-0.2, 0, 0, 0, 0});
// Sees more than the camera, in a smaller image.
const Pinhole kWide{180, 182, 131, 104, 260, 200};

TEST(RectifiedPyramid, HasTheSizeOfTheTarget) {
  PyramidBuilder builder(Rectification(kBarrel, kWide), EdgeParams());
  EXPECT_TRUE(builder.pinhole() == kWide);
  const auto pyramid = builder.build(test::textured_image(320, 240, 5));
  EXPECT_EQ(pyramid->source.width, 320);
  EXPECT_EQ(pyramid->finest().gray.width(), 260);
  EXPECT_EQ(pyramid->finest().gray.height(), 200);
  EXPECT_EQ(pyramid->levels[1].pinhole.width, 130);
  EXPECT_GT(pyramid->finest().edges.pixels.size(), 500u);
  EXPECT_THROW(builder.build(test::textured_image(260, 200, 5)), InputError)
      << "raw images are those of the camera";
}

// The texture continues to the border of the raw image, which is repeated beyond it as long stripes.
TEST(RectifiedPyramid, HasNoEdgesNearPixelsWithoutASource) {
  const Rectification rectification(kBarrel, kWide);
  const RectificationMaps maps = rectification.maps();
  ASSERT_FALSE(maps.missing.empty());
  const auto pyramid = PyramidBuilder(rectification, EdgeParams()).build(test::textured_image(320, 240, 5));
  for (size_t l = 0; l < 2; ++l)
    for (const EdgePixel& e : pyramid->levels[l].edges.pixels) {
      const int u = int(std::lround(e.x)) << l, v = int(std::lround(e.y)) << l;
      for (const auto& [du, dv] : {std::pair(-2, 0), {2, 0}, {0, -2}, {0, 2}})
        EXPECT_FALSE(maps.missing[size_t((v + dv) * kWide.width + u + du)]) << l << ": " << e.x << " " << e.y;
    }
}

// The repeated border of the default target is part of the results so far (core/rectification.h).
TEST(RectifiedPyramid, TheDefaultTargetHasEdgesUpToItsBorder) {
  const Camera pincushion({300, 300, 160, 120, 320, 240}, {0.2, 0, 0, 0, 0});
  const auto repeated = PyramidBuilder(pincushion, EdgeParams()).build(test::textured_image(320, 240, 5));
  const auto masked = PyramidBuilder(Rectification(pincushion, pincushion.pinhole()), EdgeParams())
                          .build(test::textured_image(320, 240, 5));
  EXPECT_GT(repeated->finest().edges.pixels.size(), masked->finest().edges.pixels.size());
}

// Both pinholes show the same scene: an edge of one lies where that of the other does.
TEST(RectifiedPyramid, ShowsEdgesWhereTheTargetProjectsThem) {
  const GrayImage image = [] {
    GrayImage stripe{320, 240, std::vector<uint8_t>(320 * 240)};
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u) {
        const auto ray = kBarrel.unproject({double(u), double(v)});
        const double x = ray->x() / ray->z() - 0.25 * ray->y() / ray->z();  // the line x = 0.1 + y / 4
        stripe.pixels[size_t(v) * 320 + u] = uint8_t(std::lround(120 + 80 * std::tanh(300 * (x - 0.1))));
      }
    return stripe;
  }();
  const auto pyramid = PyramidBuilder(Rectification(kBarrel, kWide), EdgeParams()).build(image);
  int on_line = 0;
  for (const EdgePixel& e : pyramid->finest().edges.pixels) {
    const Eigen::Vector3d ray = kWide.ray(e.position().cast<double>());
    EXPECT_NEAR(ray.x() - 0.25 * ray.y(), 0.1, 0.3 / kWide.fx);
    ++on_line;
  }
  EXPECT_GT(on_line, 100);
}

TEST(RectifiedPyramid, AnImageWithFewerPixelsThanItsSizeIsRefused) {
  PyramidBuilder builder(Rectification(kBarrel, kWide), EdgeParams());
  GrayImage image = test::textured_image(320, 240, 5);
  image.pixels.resize(1000);
  image.pixels.shrink_to_fit();
  EXPECT_THROW(builder.build(image), InputError);
  EXPECT_THROW(builder.build(Frame{0, {}, image}), InputError);
}

}  // namespace
}  // namespace edgevo
