// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/order_statistics.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

using Values = std::vector<double>;

TEST(OrderStatistics, MedianIsTheMiddleValue) {
  EXPECT_EQ(median(Values{7, -2, 5}), 5);
  EXPECT_EQ(median(Values{9}), 9);
  EXPECT_EQ(median(Values{4, 1, 3, 2}), 3) << "the larger of two";
  EXPECT_EQ(median(Values{}), 0);
}

TEST(OrderStatistics, QuantileIsTheValueAtAShareOfTheOrder) {
  const std::vector<int> values{50, 10, 40, 20, 30};
  EXPECT_EQ(quantile(values, 0), 10);
  EXPECT_EQ(quantile(values, 0.25), 20);
  EXPECT_EQ(quantile(values, 0.99), 40);
  EXPECT_EQ(quantile(values, 1), 50);
  EXPECT_EQ(quantile(std::vector<int>{}, 0.5), 0);
}

TEST(OrderStatistics, EachRankHasItsValue) {
  for (size_t rank = 0; rank < 4; ++rank) EXPECT_EQ(of_rank(Values{3, 0, 2, 1}, rank), double(rank));
}

}  // namespace
}  // namespace edgevo
