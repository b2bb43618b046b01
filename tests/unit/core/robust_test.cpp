// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/robust.h"

#include <gtest/gtest.h>

#include "support/numerical_jacobian.h"

namespace edgevo {
namespace {

TEST(Robust, HuberWeightIsOneInsideAndFallsOutside) {
  EXPECT_EQ(huber_weight(0, 1.5), 1.0);
  EXPECT_EQ(huber_weight(-1.5, 1.5), 1.0);
  EXPECT_DOUBLE_EQ(huber_weight(3.0, 1.5), 0.5);
  EXPECT_DOUBLE_EQ(huber_weight(-6.0, 1.5), 0.25);
}

TEST(Robust, HuberCostHasTheWeightAsItsDerivative) {
  constexpr double width = 1.3;
  for (double r : {-5.0, -1.4, -1.2, -0.1, 0.0, 0.7, 1.29, 1.31, 8.0}) {
    const auto cost = [](double x) { return huber_cost(x, width); };
    EXPECT_NEAR(test::numerical_derivative(cost, r), huber_weight(r, width) * r, 1e-9) << r;
  }
  EXPECT_NEAR(huber_cost(width - 1e-12, width), huber_cost(width + 1e-12, width), 1e-11);
}

}  // namespace
}  // namespace edgevo
