// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/sample_square.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

template <int kSide, class T>
void expect_same_bytes() {
  Random random(5);
  // Exactly the columns that are read: a sanitizer reports any other.
  const int columns = wide_square_columns(kSide);
  std::vector<T> image(size_t(columns) * (kSide + 1));
  for (T& value : image) value = T(random.below(256));
  for (const float fraction : {0.0f, 0.3f, 0.8f}) {
    std::vector<float> one_by_one(size_t(kSide * kSide)), wide(size_t(wide_square_floats(kSide)));
    sample_square<kSide>(image.data(), columns, fraction, 1 - fraction, one_by_one.data());
    sample_square_wide<kSide>(image.data(), columns, fraction, 1 - fraction, wide.data());
    EXPECT_EQ(std::memcmp(one_by_one.data(), wide.data(), sizeof(float) * kSide * kSide), 0) << kSide;
  }
}

TEST(SampleSquare, HasTheSameBytesEightAtATime) {
  expect_same_bytes<5, uint8_t>();
  expect_same_bytes<7, uint8_t>();
  expect_same_bytes<9, uint8_t>();
  expect_same_bytes<11, uint8_t>();
  expect_same_bytes<5, uint16_t>();
  expect_same_bytes<11, uint16_t>();
  expect_same_bytes<5, float>();
  expect_same_bytes<7, float>();
  expect_same_bytes<9, float>();
  expect_same_bytes<11, float>();
}

}  // namespace
}  // namespace edgevo
