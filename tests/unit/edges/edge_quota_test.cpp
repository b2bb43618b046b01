// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "edgevo/edges/edge_extraction.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

constexpr int kQuotaWidth = 1200, kQuotaHeight = 800, kDashPx = 40;

// Gray values that rise down the columns, from 255 on again from 0: six times as fast in the crowded left
// half.
Gradient half_steep() {
  GrayImage image{kQuotaWidth, kQuotaHeight, std::vector<uint8_t>(kQuotaWidth * kQuotaHeight)};
  for (int y = 0; y < kQuotaHeight; ++y)
    for (int x = 0; x < kQuotaWidth; ++x)
      image.pixels[size_t(kQuotaWidth * y + x)] = uint8_t((x < kQuotaWidth / 2 ? 12 : 2) * y % 256);
  return compute_gradient(image.view());
}

// Dashes in every `left_rows`th row of the left half and every 80th of the right.
Plane<uint8_t> dashes(int left_rows) {
  Plane<uint8_t> mask(kQuotaWidth, kQuotaHeight);
  std::fill_n(mask.row(0), kQuotaWidth * kQuotaHeight, uint8_t(0));
  for (int y = 8; y < kQuotaHeight - 8; ++y)
    for (int x = 8; x < kQuotaWidth - 8; ++x) {
      const bool is_left = x < kQuotaWidth / 2 - kDashPx;
      if (y % (is_left ? left_rows : 80) == 0 && x % (kDashPx + 4) < kDashPx)
        mask.at(x, y) = is_left || x > kQuotaWidth / 2 + kDashPx ? 255 : 0;
    }
  return mask;
}

int right_of_middle(const ImageEdges& edges) {
  return int(std::count_if(edges.pixels.begin(), edges.pixels.end(),
                           [](const EdgePixel& e) { return e.position().x() > kQuotaWidth / 2; }));
}

TEST(EdgeQuota, ACrowdedPartLosesEdgesAndAnEmptyOneKeepsItsWeakOnes) {
  const Gradient gradient = half_steep();
  const ImageEdges few = extract_edges(dashes(16), gradient, 10),
                   many = extract_edges(dashes(4), gradient, 10);
  ASSERT_LT(few.pixels.size(), 48000u);
  EXPECT_GT(many.pixels.size(), 40000u);
  EXPECT_LT(many.pixels.size(), 53000u) << "of 100,000";
  EXPECT_GT(right_of_middle(few), 2000);
  EXPECT_EQ(right_of_middle(many), right_of_middle(few));
}

TEST(EdgeQuota, WhatIsKeptIsWhole) {
  const ImageEdges edges = extract_edges(dashes(4), half_steep(), 10);
  for (const EdgeChain& chain : edges.chains) {
    const bool is_cut_by_border = edges.pixels[size_t(chain.begin)].position().x() < 2 * kDashPx;
    if (!is_cut_by_border &&
        edges.pixels[size_t(chain.end - 1)].position().x() < kQuotaWidth / 2 - 2 * kDashPx) {
      EXPECT_EQ(chain.length(), kDashPx);
    }
  }
}

}  // namespace
}  // namespace edgevo
