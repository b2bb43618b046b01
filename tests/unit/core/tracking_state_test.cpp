// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/tracking_state.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(TrackingState, HasANameForEachValue) {
  EXPECT_EQ(to_string(TrackingState::kBootstrapping), "BOOTSTRAPPING");
  EXPECT_EQ(to_string(TrackingState::kTracking), "TRACKING");
  EXPECT_EQ(to_string(TrackingState::kDegraded), "DEGRADED");
  EXPECT_EQ(to_string(TrackingState::kLost), "LOST");
}

}  // namespace
}  // namespace edgevo
