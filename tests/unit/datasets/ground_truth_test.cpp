// SPDX-License-Identifier: BSD-3-Clause
// Ground truth for frames that are played backward.
#include "edgevo/datasets/ground_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

TEST(GroundTruthText, PlayedBackwardMirrorsTimesBetweenFirstAndLastFrame) {
  const std::string text =
      "# a comment\n0.5 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n\n1.5 3 0 0 0 0 0 1\n4 9 0 0 0 0 0 1\n";
  EXPECT_EQ(played_backward(text, Timestamp::from_seconds(1), Timestamp::from_seconds(2)),
            "# played backward: t tx ty tz qx qy qz qw\n1.5000000 3 0 0 0 0 0 1\n2.0000000 2 0 0 0 0 0 "
            "1\n2.5000000 1 0 0 0 0 0 1\n")
      << "a pose before time 0 is dropped";
}

TEST(GroundTruthText, ALineWithoutATimeIsReported) {
  try {
    played_backward("0.5 1 0 0 0 0 0 1\nnonsense\n", {}, {});
    FAIL() << "nothing was thrown";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("has no time in 'nonsense'"));
  }
}

}  // namespace
}  // namespace edgevo
