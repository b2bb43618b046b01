// SPDX-License-Identifier: BSD-3-Clause
// How an estimate of a number of the camera is classified.
#include "finding.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

using State = CameraRefinement::State;

constexpr FindingCriteria kCriteria{0.004, 0.03, 3, 1.5};

State state_after(State before, double estimate, double sigma) {
  return weigh(before, estimate, 0, sigma, kCriteria).state;
}

TEST(WeighFinding, DistinguishesFourStates) {
  EXPECT_EQ(state_after(State::kTooEarly, 0.02, 0.005), State::kNotObservable);
  EXPECT_EQ(state_after(State::kTooEarly, 0.002, 0.001), State::kInsignificant);
  EXPECT_EQ(state_after(State::kTooEarly, 0.03, 0.001), State::kAtLimit);
  EXPECT_EQ(state_after(State::kTooEarly, 0.02, 0.001), State::kApplied);
}

// Only a trustworthy estimate close to the file's number resets an applied value.
TEST(WeighFinding, AnAppliedValueStays) {
  EXPECT_EQ(state_after(State::kApplied, 0.002, 0.001),
            State::kApplied);                                             // 2 sigma: not enough to begin with
  EXPECT_EQ(state_after(State::kApplied, 0.02, 0.005), State::kApplied);  // not observed this time
  EXPECT_EQ(state_after(State::kApplied, 0.03, 0.001), State::kApplied);  // at the limit
  EXPECT_FALSE(weigh(State::kApplied, 0.03, 0, 0.001, kCriteria).trustworthy);
  EXPECT_EQ(state_after(State::kApplied, 0.001, 0.001), State::kInsignificant);
}

TEST(WeighFinding, ComparesWithTheFilesNumber) {
  EXPECT_EQ(weigh(State::kTooEarly, 0.02, 0.019, 0.001, kCriteria).state, State::kInsignificant);
}

// Matches are biased alike however many there are: a formal standard deviation near zero is not trusted.
TEST(FindingSigmas, BiasedMatchesAreAccountedFor) {
  EXPECT_DOUBLE_EQ(k1_sigma(0, 30), 0.004);
  EXPECT_DOUBLE_EQ(k1_sigma(0, 120), 0.004 / 4);
  EXPECT_DOUBLE_EQ(k1_sigma(0.003, 30), 0.005);
  EXPECT_DOUBLE_EQ(readout_sigma(0, 30), 0.0015);
  EXPECT_DOUBLE_EQ(readout_sigma(0, 120), 0.0015 / 2);
}

}  // namespace
}  // namespace edgevo
