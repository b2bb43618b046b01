// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/nearest_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

ImageEdges random_edges(int width, int height, int count, uint64_t seed) {
  Random random(seed);
  ImageEdges map;
  map.width = width, map.height = height;
  std::vector<bool> taken(size_t(width) * height, false);
  for (int i = 0; i < count; ++i) {
    const int x = random.below(width), y = random.below(height);
    if (taken[size_t(y) * width + x]) continue;  // at most one edge pixel per pixel, as in extracted edges
    taken[size_t(y) * width + x] = true;
    EdgePixel e;
    e.x = float(x), e.y = float(y), e.nx = 1;
    map.pixels.push_back(e);
  }
  map.chains.push_back({0, int(map.pixels.size())});
  return map;
}

// Squared distance from (x, y) to the nearest edge pixel; -1 if none lies within the radius.
int brute_force(const ImageEdges& map, int x, int y, int radius) {
  int best = radius * radius + 1;
  for (const EdgePixel& e : map.pixels) {
    const int dx = int(e.x) - x, dy = int(e.y) - y;
    best = std::min(best, dx * dx + dy * dy);
  }
  return best <= radius * radius ? best : -1;
}

struct Case {
  int width, height, count, radius;
};

class NearestFieldSizes : public ::testing::TestWithParam<Case> {};

TEST_P(NearestFieldSizes, EqualsBruteForceEverywhere) {
  const Case c = GetParam();
  const ImageEdges map = random_edges(c.width, c.height, c.count, 7);
  const NearestField field(map, c.radius);
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const int expected = brute_force(map, x, y, c.radius);
      const int n = field.nearest_at(x, y);
      if (expected < 0) {
        ASSERT_EQ(n, -1) << x << " " << y;
        continue;
      }
      ASSERT_GE(n, 0) << x << " " << y;
      const int dx = int(map.pixels[n].x) - x, dy = int(map.pixels[n].y) - y;
      ASSERT_EQ(dx * dx + dy * dy, expected) << x << " " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, NearestFieldSizes,
                         ::testing::Values(Case{97, 61, 150, 12}, Case{97, 61, 15, 15}, Case{64, 64, 2000, 3},
                                           Case{33, 7, 4, 15}, Case{1, 1, 1, 2}, Case{1, 40, 3, 12},
                                           Case{40, 1, 3, 12}, Case{50, 50, 0, 12}));

TEST(NearestField, RoundsTheQueryAndRejectsPositionsOutside) {
  ImageEdges map = random_edges(20, 10, 0, 1);
  EdgePixel e;
  e.x = 5.3f, e.y = 4.6f;  // lies in pixel (5, 5)
  map.pixels.push_back(e);
  map.chains = {{0, 1}};
  const NearestField field(map, 4);
  EXPECT_EQ(field.nearest(5.4f, 5.4f), 0);
  EXPECT_EQ(field.nearest(9.4f, 5.0f), 0);
  EXPECT_EQ(field.nearest(9.6f, 5.0f), -1);
  EXPECT_EQ(field.nearest(-0.6f, 5.0f), -1);
  EXPECT_EQ(field.nearest(5.0f, 9.6f), -1);
  EXPECT_EQ(field.nearest(std::nanf(""), 5.0f), -1);
}

}  // namespace
}  // namespace edgevo
