// SPDX-License-Identifier: BSD-3-Clause
// Whether the chain's covariance is that of its errors: the normalised square of the error (NEES) over its
// six degrees of freedom, 1 where it is, of corners with known noise along a made street, over many seeds.
#include "corner_chain.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "corner_evaluation.h"
#include "support/corner_street.h"

namespace edgevo {
namespace {

constexpr int kSeeds = 40, kFirst = 40, kLast = 90, kBetween = 5;  // frames that are evaluated

// The chain's path next to the true one.
struct ChainRun {
  std::vector<SE3> truth;
  std::vector<ChainStep> steps;

  // True lengths in the unit of the path, by the 25 steps up to `frame`.
  double unit_before(int frame) const {
    double length = 0, true_length = 0;
    for (int k = frame - 25; k < frame; ++k) {
      const size_t i = size_t(k);
      length += (steps[i + 1].T_cam_path * steps[i].T_cam_path.inverse()).translation().norm();
      true_length += (truth[i + 1] * truth[i].inverse()).translation().norm();
    }
    return length / true_length;
  }
  // NEES over six of the motion from `from` to `to`, in the unit of the frames before. The covariance is that
  // of both poses.
  double nees(int from, int to) const {
    const ChainStep &a = steps[size_t(from)], &b = steps[size_t(to)];
    const SE3 found = b.T_cam_path * a.T_cam_path.inverse(),
              true_motion = truth[size_t(to)] * truth[size_t(from)].inverse();
    const SE3 expected(true_motion.rotation(), unit_before(from) * true_motion.translation());
    const Vector6d xi = (found * expected.inverse()).log();
    const Matrix6d covariance = b.covariance + found.adjoint() * a.covariance * found.adjoint().transpose();
    return xi.dot(covariance.ldlt().solve(xi)) / 6;
  }
};

ChainRun run_chain(unsigned seed, double noise_px) {
  test::CornerStreet street(0, seed, noise_px);
  CornerChain chain;
  chain.expect_idepth(0.1);
  ChainRun run;
  SE3 T_cam_world;
  for (int i = 0; i <= kLast; ++i) {
    const SE3 step = test::street_drive(i);
    if (i > 0) T_cam_world = step * T_cam_world;
    run.steps.push_back(
        chain.add(street.look(T_cam_world, i), i > 0 ? std::optional<SE3>(step) : std::nullopt));
    run.truth.push_back(T_cam_world);
  }
  return run;
}

// Mean over seeds and frames of the NEES of motions over `frames`.
double mean_nees(int frames, double noise_px) {
  double sum = 0;
  int n = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const ChainRun run = run_chain(seed, noise_px);
    for (int i = kFirst; i <= kLast; i += kBetween) {
      EXPECT_TRUE(run.steps[size_t(i)].is_measured) << seed << ", frame " << i;
      sum += run.nees(i - frames, i), ++n;
    }
  }
  return sum / n;
}

constexpr double kAssumed = 0.4;  // pixels, the noise that the chain expects

// A little too large: what is wrong with anchors and depths moves both poses alike.
TEST(CornerChain, TheCovarianceOfAStepIsThatOfItsError) {
  const double nees = mean_nees(1, kAssumed);
  EXPECT_GT(nees, 0.55);  // measured: 0.75, other seeds 0.66 to 0.84
  EXPECT_LT(nees, 1);
}

// A quarter of the variance: corners are followed better than that.
TEST(CornerChain, TheCovarianceOfAStepIsTooLargeForSharperCorners) {
  const double nees = mean_nees(1, kAssumed / 2);
  EXPECT_GT(nees, 0.2);  // measured: 0.28, other seeds 0.27 to 0.31
  EXPECT_LT(nees, 0.4);
}

// NOT consistent: the covariance is that of a pose given depths and anchors, and their errors, which the path
// itself makes, are common to neighbours and grow from step to step. So over ten steps it is too small by 16,
// its sigmas by 4 (five sets of 40 seeds: 8 to 24). Held where it is: a change for the better takes the
// bounds with it.
TEST(CornerChain, OverTenStepsErrorsAreFourOfItsSigmasAndNotMore) {
  const double nees = mean_nees(10, kAssumed);
  EXPECT_GT(nees, 6);  // measured: 15.7
  EXPECT_LT(nees, 28);
}

TEST(CornerChain, OverTenStepsErrorsOfSharperCornersAreTwoOfItsSigmas) {
  const double nees = mean_nees(10, kAssumed / 2);
  EXPECT_GT(nees, 1.8);  // measured: 3.7, other seeds 2.3 to 5.5
  EXPECT_LT(nees, 7);
}

// Root mean square of what corners say against a right odometry, in their standard deviations.
struct ErrorsInSigmas {
  double motion = 0, rotation = 0, change_10 = 0, change_50 = 0;
  double beyond = 0;  // share of the frames with a motion error of more than 2.5 of them
};

ErrorsInSigmas errors_of_right_odometry(double noise_px) {
  ErrorsInSigmas sum;
  int n = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    test::CornerStreet street(0, seed, noise_px);
    CornerEvaluation evaluation;
    SE3 T_cam_world;
    evaluation.add(street.look(T_cam_world, 0), std::nullopt);
    evaluation.begin_map(0.1);
    for (int i = 1; i <= 130; ++i) {
      T_cam_world = test::street_drive(i) * T_cam_world;
      const CornerEvidence e = evaluation.add(street.look(T_cam_world, i), test::street_drive(i)).value();
      if (i < 110 || i % kBetween != 0) continue;
      if (!std::isfinite(e.motion_error)) continue;  // the chain has begun anew
      sum.motion += std::pow(e.motion_error / e.motion_sigma, 2);
      sum.rotation += std::pow(e.rotation_deg / e.rotation_sigma_deg, 2);
      sum.change_10 += std::pow(e.change_10 / e.change_10_sigma, 2);
      sum.change_50 += std::pow(e.change_50 / e.change_50_sigma, 2);
      sum.beyond += e.motion_error > 2.5 * e.motion_sigma;
      ++n;
    }
  }
  EXPECT_GT(n, 4 * kSeeds);  // of five frames each
  const auto rms = [&](double squares) { return std::sqrt(squares / n); };
  return {rms(sum.motion), rms(sum.rotation), rms(sum.change_10), rms(sum.change_50), sum.beyond / n};
}

// The drift of the unit, which is added to the sigmas of lengths, makes up for it; rotations have no such
// term: their sigma is too small by 2.4, of a few hundredths of a degree.
TEST(CornerChain, SigmasOfTheEvidenceHoldForLengthsAndNotForRotations) {
  const ErrorsInSigmas errors = errors_of_right_odometry(kAssumed);
  EXPECT_GT(errors.motion, 0.75);  // measured: 1.08
  EXPECT_LT(errors.motion, 1.5);
  EXPECT_GT(errors.change_10, 0.5);  // measured: 0.86
  EXPECT_LT(errors.change_10, 1.2);
  EXPECT_GT(errors.change_50, 0.6);  // measured: 1.09
  EXPECT_LT(errors.change_50, 1.5);
  EXPECT_GT(errors.rotation, 1.8);  // measured: 2.4
  EXPECT_LT(errors.rotation, 3.1);
  EXPECT_LT(errors.beyond, 0.1) << "of right motions; measured: 0.035, other seeds up to 0.08";
}

}  // namespace
}  // namespace edgevo
