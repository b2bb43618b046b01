// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace edgevo {
namespace {

// Published sequence of SplitMix64 for the seed 1234567: the numbers must never change, on any machine.
TEST(Random, IsSplitMix64) {
  Random random(1234567);
  for (uint64_t expected : {6457827717110365317ull, 3203168211198807973ull, 9817491932198370423ull,
                            4593380528125082431ull, 16408922859458223821ull})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, DerivedStreamsAreFixedAndDiffer) {
  EXPECT_EQ(Random::derive(1, 2).next(), Random::derive(1, 2).next());
  std::set<uint64_t> first;
  for (uint64_t seed = 0; seed < 20; ++seed)
    for (uint64_t purpose = 0; purpose < 20; ++purpose) first.insert(Random::derive(seed, purpose).next());
  EXPECT_EQ(first.size(), 400u);
}

TEST(Random, UniformCoversItsRangeEvenly) {
  Random random(3);
  int bins[10] = {};
  for (int i = 0; i < 100000; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[int(10 * u)];
  }
  for (int count : bins) EXPECT_NEAR(count, 10000, 500);
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform(-2, 3);
    EXPECT_TRUE(u >= -2 && u < 3);
  }
}

TEST(Random, BelowStaysBelow) {
  Random random(4);
  std::set<int> seen;
  for (int i = 0; i < 1000; ++i) seen.insert(random.below(7));
  EXPECT_EQ(seen, (std::set<int>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(random.below(1), 0);
}

TEST(Random, NormalHasMeanZeroAndStandardDeviationOne) {
  Random random(5);
  double sum = 0, square = 0, fourth = 0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    ASSERT_TRUE(std::isfinite(x));
    sum += x, square += x * x, fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / n, 0, 0.01);
  EXPECT_NEAR(square / n, 1, 0.02);
  EXPECT_NEAR(fourth / n, 3, 0.1);
}

}  // namespace
}  // namespace edgevo
