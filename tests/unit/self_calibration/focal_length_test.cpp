// SPDX-License-Identifier: BSD-3-Clause
// When a focal length that corners show is tried, and applied.
#include <gtest/gtest.h>

#include "edgevo/core/records.h"
#include "focal_length.h"

namespace edgevo {
namespace {

constexpr double kSignificance = 3;

CameraRefinement found(double estimate, double sigma, double in_use = 0) {
  CameraRefinement known;
  known.focal_length.estimate = estimate, known.focal_length.sigma = sigma;
  known.focal_length.windows = 3;
  known.correction.focal = in_use;
  return known;
}

std::optional<double> tried(const CameraRefinement& known) {
  return focal_length_to_try(known, kSignificance);
}

TEST(FocalLength, IsTriedWhereCornersContradictTheFile) {
  EXPECT_FALSE(tried({})) << "no estimate";
  EXPECT_EQ(tried(found(0.2, 0.09)), 0.2);
  EXPECT_EQ(tried(found(-0.2, 0.09)), -0.2);
  EXPECT_FALSE(tried(found(0.17, 0.09)));
}

// Matches are biased towards the focal length that they were found with: against one that is far off they may
// speak a little, for one that is less far off they must.
TEST(FocalLength, IsAppliedWhereTheMapSupportsIt) {
  const auto is_applied = [](double estimate, double sigma, double cost_ratio) {
    return is_supported_by_map(found(estimate, sigma), cost_ratio, kSignificance);
  };
  EXPECT_TRUE(is_applied(0.2, 0.06, 1.1));
  EXPECT_FALSE(is_applied(0.2, 0.06, 1.5));
  EXPECT_FALSE(is_applied(0.2, 0.09, 1.1));
  EXPECT_TRUE(is_applied(0.2, 0.09, 0.9));
}

TEST(FocalLength, FollowsALaterEstimate) {
  EXPECT_FALSE(tried(found(0.22, 0.05, 0.2))) << "the same within its standard deviation";
  EXPECT_EQ(tried(found(0.13, 0.05, 0.2)), 0.13);
  EXPECT_EQ(tried(found(0.05, 0.05, 0.2)), 0.0) << "the file was right";
}

TEST(FocalLength, IsNotTriedAtItsLimit) {
  EXPECT_TRUE(tried(found(0.6, 0.05)));
  EXPECT_FALSE(tried(found(0.69, 0.05))) << "the true one may be larger still";
}

TEST(FocalLength, WaitsForAnotherWindowWhereTheMapSpokeAgainstIt) {
  CameraRefinement known = found(0.2, 0.05);
  known.focal_length.windows_rejected = known.focal_length.windows;
  EXPECT_FALSE(tried(known));
  ++known.focal_length.windows;
  EXPECT_TRUE(tried(known));
}

}  // namespace
}  // namespace edgevo
