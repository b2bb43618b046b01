// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/tracker.h"

#include <gmock/gmock.h>

#include "support/inlier_scorer.h"
#include "support/plane_scene.h"
#include "support/pose_matchers.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::SE3Near;
using test::twist;

constexpr double kDegree = M_PI / 180;
constexpr double kWeak = 0.01;  // standard deviation of a poorly observed direction

TrackResult track_from(const std::vector<SE3>& starts, const FramePyramid& current,
                       const ReferenceCloud& cloud, const AlignmentParams& params = {}) {
  return track(current, cloud, starts, test::InlierScorer(), params);
}

class TrackMotions : public ::testing::TestWithParam<Vector6d> {};

TEST_P(TrackMotions, FindsThePoseFromTheReferencePose) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(GetParam());
  const ReferenceCloud cloud = scene.cloud(SE3());
  ASSERT_GT(cloud.points.size(), 300u);
  const TrackResult r = track_from({SE3()}, *scene.pyramid(T_cur_ref.inverse()), cloud);
  EXPECT_GT(r.evidence.inlier_share, 0.8);
  EXPECT_LT(r.sigmas.maxCoeff(), kWeak);
  // In front of a plane, rotation and sideways motion look alike: 0.06 degrees and 6 mm together move the
  // points by 0.06 pixels.
  EXPECT_THAT(r.T_cur_ref, SE3Near(T_cur_ref, 0.01, 0.08 * kDegree));
}

INSTANTIATE_TEST_SUITE_P(Motions, TrackMotions,
                         ::testing::Values(Vector6d::Zero(), twist(0.1, 0, 0, 0, 0, 0),
                                           twist(0, 0, 0.2, 0, 0, 0), twist(0, 0, 0, 0, 0.04, 0),
                                           twist(0, 0, 0, 0, 0, 0.06),
                                           twist(0.1, -0.08, 0.15, 0.02, -0.03, 0.02)));

TEST(Track, HoldsUnderAnExposureJump) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.08, 0.02, 0.1, 0.01, -0.02, 0.01));
  const TrackResult r = track_from({SE3()}, *scene.pyramid(T_cur_ref.inverse(), 0.5, 30), scene.cloud(SE3()));
  EXPECT_GT(r.evidence.inlier_share, 0.8);
  EXPECT_THAT(r.T_cur_ref, SE3Near(T_cur_ref, 0.01, 0.08 * kDegree));
}

TEST(Track, TriesTheOtherStartsWhenTheFirstIsBad) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.05, 0, 0, 0, 0.01, 0));
  const SE3 bad = SE3::exp(twist(0, 0, 0, 0, 0.9, 0));
  const TrackResult r = track_from({bad, SE3()}, *scene.pyramid(T_cur_ref.inverse()), scene.cloud(SE3()));
  EXPECT_GT(r.evidence.inlier_share, 0.8);
}

TEST(Track, PhotometricCostAgreesWithTheTruth) {
  const test::PlaneScene scene;
  AlignmentParams params;
  params.photometric = true;
  const SE3 T_cur_ref = SE3::exp(twist(0.08, 0.02, 0.1, 0.01, -0.02, 0.01));
  const TrackResult r =
      track_from({SE3()}, *scene.pyramid(T_cur_ref.inverse()), scene.cloud(SE3(), 4, true), params);
  EXPECT_THAT(r.T_cur_ref, SE3Near(T_cur_ref, 0.01, 0.05 * kDegree));
}

TEST(Track, ABlackImageHasNoInliersAndAnUncertainPose) {
  const test::PlaneScene scene;
  const TrackResult r = track_from({SE3()}, *scene.pyramid(SE3(), 0.0, 0.0), scene.cloud(SE3()));
  EXPECT_EQ(r.evidence.inlier_share, 0);
  EXPECT_GT(r.sigmas.minCoeff(), kWeak);
}

TEST(Track, AnotherSceneHasFewInliers) {
  const test::PlaneScene scene(11), other(99);
  EXPECT_LT(track_from({SE3()}, *other.pyramid(SE3()), scene.cloud(SE3())).evidence.inlier_share, 0.15);
}

TEST(Track, AnEmptyCloudHasNoVisiblePoints) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = make_reference_cloud(scene.pyramid(SE3()), {}, false);
  EXPECT_EQ(track_from({SE3()}, *scene.pyramid(SE3()), cloud).stats.visible, 0);
}

// Standard deviations and directions are those of the covariance, translation in median depths.
TEST(Assess, ThePrincipalDirectionsMakeUpTheCovariance) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = scene.cloud(SE3());
  const TrackResult r = track_from({SE3()}, *scene.pyramid(SE3()), cloud);
  const Matrix6d scaled =
      r.directions * Matrix6d(r.sigmas.cwiseAbs2().asDiagonal()) * r.directions.transpose();
  const double depth = std::sqrt(r.covariance(0, 0) / scaled(0, 0));
  EXPECT_NEAR(depth, 5, 1.5) << "the median depth of the plane";
  EXPECT_NEAR(scaled(1, 5), r.covariance(1, 5) / depth, 1e-6 * std::abs(scaled(1, 5)));
  EXPECT_NEAR(scaled(4, 4), r.covariance(4, 4), 1e-6 * r.covariance(4, 4));
  for (int i = 1; i < 6; ++i) EXPECT_GE(r.sigmas[i], r.sigmas[i - 1]);
}

TEST(Assess, APoseThatIsNotFiniteHasNoCovariance) {
  const test::PlaneScene scene;
  PoseCandidate pose;
  pose.T_cur_ref = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(std::nan(""), 0, 0));
  EXPECT_EQ(assess(*scene.pyramid(SE3()), scene.cloud(SE3()), pose, AlignmentParams()).covariance,
            Matrix6d(Matrix6d::Zero()));
}

// All edges parallel: motion along them is not observable, and the covariance must show it.
TEST(Track, ParallelEdgesLeaveADirectionUncertain) {
  const GrayImage stripes =
      test::make_image(320, 240, [](double x, double) { return 128 + 90 * std::sin(x / 6.0); });
  Camera camera;
  camera.set_pinhole({260, 260, 159.5, 119.5, 320, 240});
  PyramidBuilder builder(camera, EdgeParams());
  const auto pyramid = builder.build(stripes);
  std::vector<CloudPoint> points;
  for (size_t i = 0; i < pyramid->finest().edges.pixels.size(); i += 4) {
    const EdgePixel& e = pyramid->finest().edges.pixels[i];
    points.push_back(
        {camera.pinhole().ray(e.position().cast<double>()), 0.2, 0.001, e.position(), e.normal()});
  }
  const TrackResult r = track_from({SE3()}, *pyramid, make_reference_cloud(pyramid, points, false));
  EXPECT_GT(r.evidence.inlier_share, 0.8);
  double along = 0;  // translation in y is among the uncertain directions
  for (int i = 0; i < 6; ++i)
    if (r.sigmas[i] > kWeak) along = std::max(along, std::abs(r.directions(1, i)));
  EXPECT_GT(along, 0.5);
}

TEST(MotionHypotheses, FirstIsConstantVelocity) {
  const SE3 last = SE3::exp(twist(0.1, 0, 0.3, 0, 0.02, 0)), motion = SE3::exp(twist(0, 0, 0.1, 0, 0.01, 0));
  const auto starts = motion_hypotheses(last, motion);
  EXPECT_LT((starts.front() * (motion * last).inverse()).log().norm(), 1e-12);
  EXPECT_LT((starts[1] * last.inverse()).log().norm(), 1e-12);
}

}  // namespace
}  // namespace edgevo
