// SPDX-License-Identifier: BSD-3-Clause
// Which of many relations between epochs hold.
#include "unit_guess.h"

#include <gtest/gtest.h>

#include <cmath>

namespace edgevo {
namespace {

constexpr size_t kEpochs = 40;

Constraint relation(double ratio, double sigma, double fails, double sigma_then) {
  Constraint c =
      scale_constraint(ConstraintKind::kFeatures, NodeId::epoch(0, 0), NodeId::epoch(0, 1), ratio, sigma);
  c.failure = {fails, covariance_of_scale(sigma_then)};
  return c;
}
UnitRelation kept(size_t epoch) { return {epoch - 1, epoch, relation(1, 0.01, 0.3, 1)}; }
UnitRelation linked(size_t from, size_t to, double ratio) {
  return {from, to, relation(ratio, 0.03, 0.1, 0.3)};
}

// Lengths double at every tenth epoch.
double unit(size_t epoch) { return std::pow(2.0, double(epoch / 10)); }

std::vector<UnitRelation> drive() {
  std::vector<UnitRelation> relations;
  for (size_t i = 1; i < kEpochs; ++i) {
    relations.push_back(kept(i));
    for (const size_t back : {1, 2})
      if (i >= back) relations.push_back(linked(i - back, i, unit(i) / unit(i - back)));
  }
  return relations;
}

void expect_found(const std::vector<UnitRelation>& relations) {
  const std::vector<double> guess = guess_units(kEpochs, relations);
  ASSERT_EQ(guess.size(), kEpochs);
  for (size_t i = 0; i < kEpochs; ++i) EXPECT_NEAR(guess[i], std::log(unit(i)), 0.1) << i;
}

TEST(UnitGuess, FindsWhereTheUnitWasLost) { expect_found(drive()); }

TEST(UnitGuess, IsNotMisledByMistakenRelations) {
  std::vector<UnitRelation> relations = drive();
  for (size_t i = 3; i < kEpochs; i += 3) {
    relations.push_back(linked(i - 1, i, 1.5 * unit(i) / unit(i - 1)));
    relations.push_back(linked(i - 3, i, 0.4 * unit(i) / unit(i - 3)));
  }
  expect_found(relations);
}

TEST(UnitGuess, OneEpochMayHaveAUnitOfItsOwn) {
  std::vector<UnitRelation> relations;
  for (size_t i = 1; i < kEpochs; ++i) relations.push_back(kept(i));
  relations.push_back(linked(16, 17, 3));
  relations.push_back(linked(17, 18, 1.0 / 3));
  const std::vector<double> guess = guess_units(kEpochs, relations);
  for (size_t i = 0; i < kEpochs; ++i) EXPECT_NEAR(guess[i], i == 17 ? std::log(3) : 0, 1e-9) << i;
}

TEST(UnitGuess, WithoutRelationsAllUnitsAreOne) {
  EXPECT_EQ(guess_units(3, {}), (std::vector<double>{0, 0, 0}));
}

}  // namespace
}  // namespace edgevo
