// SPDX-License-Identifier: BSD-3-Clause
// When what corners show of the focal length is weighed against the map, and how it enters.
#include "focal_length.h"

#include <gtest/gtest.h>

#include "edgevo/core/records.h"
#include "edgevo/self_calibration/lens_estimate.h"

namespace edgevo {
namespace {

CameraPosterior by_corners(double estimate, double sigma, double in_use = 0) {
  CameraPosterior known;
  known.corners.focal = estimate, known.corners.sigma = sigma;
  known.corners.windows = 3;
  known.applied.focal = in_use;
  return known;
}

TEST(FocalLength, CornersContradictWhatIsInUse) {
  EXPECT_FALSE(do_corners_contradict({})) << "no estimate";
  EXPECT_TRUE(do_corners_contradict(by_corners(0.2, 0.06)));
  EXPECT_TRUE(do_corners_contradict(by_corners(-0.2, 0.06)));
  EXPECT_FALSE(do_corners_contradict(by_corners(0.17, 0.06)));
  EXPECT_FALSE(do_corners_contradict(by_corners(0.22, 0.05, 0.2)))
      << "the same within its standard deviation";
  EXPECT_TRUE(do_corners_contradict(by_corners(0.04, 0.05, 0.2))) << "the file was right";
}

TEST(FocalLength, AtItsLimitItDoesNotCount) {
  EXPECT_TRUE(do_corners_contradict(by_corners(0.6, 0.05)));
  EXPECT_FALSE(do_corners_contradict(by_corners(0.69, 0.05))) << "the true one may be larger still";
}

TEST(FocalLength, IsWeighedOnceAWindow) {
  CameraPosterior known = by_corners(0.2, 0.05);
  known.corners.windows_weighed = known.corners.windows;
  EXPECT_FALSE(do_corners_contradict(known));
  ++known.corners.windows;
  EXPECT_TRUE(do_corners_contradict(known));
}

TEST(FocalLength, TheSearchStartsAtCornersThatContradict) {
  EXPECT_EQ(search_for_camera(by_corners(0.1, 0.06), true, 0.02).start.correction.focal, 0);
  EXPECT_EQ(search_for_camera(by_corners(0.2, 0.05), true, 0.02).start.correction.focal, 0.2);
  EXPECT_EQ(search_for_camera({}, true, 0.02).prior[kReadout], 0.02);
  EXPECT_TRUE(search_for_camera({}, true, 0).free[kReadout]);
  EXPECT_FALSE(search_for_camera({}, false, 0).free[kReadout]);
}

CameraEstimate by_matches(double focal, double sigma) {
  CameraEstimate e;
  e.value.correction.focal = focal;
  e.sigma[kFocal] = sigma / kSigmasOfMatches;
  return e;
}

// Near the camera in use matches know it better than corners by far, far from it they do not.
TEST(FocalLength, IsThatOfMatchesAndCornersByTheirWeights) {
  const FocalPosterior alone = focal_posterior({}, by_matches(0.02, 0.01));
  EXPECT_NEAR(alone.mean, 0.02, 1e-12);
  EXPECT_NEAR(alone.sigma, 0.01 * std::sqrt(2), 1e-12) << "half of the 2 % may be missing";
  EXPECT_NEAR(alone.sigma_in_use, 0.01, 1e-12);
  EXPECT_NEAR(focal_posterior(by_corners(-0.1, 0.05), by_matches(0, 0.002)).mean, 0, 0.001);
  EXPECT_NEAR(focal_posterior(by_corners(0.25, 0.05), by_matches(0.1, 1e-6)).mean, 0.175, 1e-4);
  const FocalPosterior later = focal_posterior(by_corners(0.25, 0.05, 0.19), by_matches(0.2, 0.01));
  EXPECT_NEAR(later.mean, 0.2, 0.005);
  EXPECT_LT(later.sigma, 0.012);
}

TEST(FocalLength, CornersAtTheirLimitDoNotCount) {
  EXPECT_NEAR(focal_posterior(by_corners(kMaxFocalError, 0.01), by_matches(0.02, 0.01)).mean, 0.02, 1e-12);
}

TEST(FocalLength, CornersAloneDoNotChangeIt) {
  const auto do_agree = [](double matches) {
    return focal_posterior(by_corners(-0.2, 0.05), by_matches(matches, 0.06)).do_matches_agree;
  };
  EXPECT_TRUE(do_agree(-0.1));
  EXPECT_FALSE(do_agree(-0.03));
  EXPECT_FALSE(do_agree(0.1));
}

}  // namespace
}  // namespace edgevo
