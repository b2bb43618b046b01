// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/tracker.h"

#include <gmock/gmock.h>

#include "support/plane_scene.h"
#include "support/pose_matchers.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::SE3Near;
using test::twist;

constexpr double kDegree = M_PI / 180;

class TrackMotions : public ::testing::TestWithParam<Vector6d> {};

TEST_P(TrackMotions, FindsThePoseFromTheReferencePose) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(GetParam());
  const ReferenceCloud cloud = scene.cloud(SE3());
  ASSERT_GT(cloud.points.size(), 300u);
  const TrackResult r = track(*scene.pyramid(T_cur_ref.inverse()), cloud, {SE3()}, AlignmentParams());
  EXPECT_EQ(r.status, TrackingState::kTracking) << r.reason;
  EXPECT_GT(r.evidence.inlier_share, 0.8);
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
  const TrackResult r =
      track(*scene.pyramid(T_cur_ref.inverse(), 0.5, 30), scene.cloud(SE3()), {SE3()}, AlignmentParams());
  EXPECT_EQ(r.status, TrackingState::kTracking) << r.reason;
  EXPECT_THAT(r.T_cur_ref, SE3Near(T_cur_ref, 0.01, 0.08 * kDegree));
}

TEST(Track, TriesTheOtherStartsWhenTheFirstIsBad) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.05, 0, 0, 0, 0.01, 0));
  const SE3 bad = SE3::exp(twist(0, 0, 0, 0, 0.9, 0));
  const TrackResult r =
      track(*scene.pyramid(T_cur_ref.inverse()), scene.cloud(SE3()), {bad, SE3()}, AlignmentParams());
  EXPECT_EQ(r.status, TrackingState::kTracking) << r.reason;
}

TEST(Track, PhotometricCostAgreesWithTheTruth) {
  const test::PlaneScene scene;
  AlignmentParams params;
  params.photometric = true;
  const SE3 T_cur_ref = SE3::exp(twist(0.08, 0.02, 0.1, 0.01, -0.02, 0.01));
  const TrackResult r =
      track(*scene.pyramid(T_cur_ref.inverse()), scene.cloud(SE3(), 4, true), {SE3()}, params);
  EXPECT_THAT(r.T_cur_ref, SE3Near(T_cur_ref, 0.01, 0.05 * kDegree));
}

TEST(Track, BlackImageIsLostWithAReason) {
  const test::PlaneScene scene;
  const TrackResult r =
      track(*scene.pyramid(SE3(), 0.0, 0.0), scene.cloud(SE3()), {SE3()}, AlignmentParams());
  EXPECT_EQ(r.status, TrackingState::kLost);
  EXPECT_FALSE(r.reason.empty());
}

TEST(Track, AnotherSceneIsNotTracked) {
  const test::PlaneScene scene(11), other(99);
  const TrackResult r = track(*other.pyramid(SE3()), scene.cloud(SE3()), {SE3()}, AlignmentParams());
  EXPECT_EQ(r.status, TrackingState::kLost) << r.evidence.inlier_share;
}

TEST(Track, EmptyCloudIsLost) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = make_reference_cloud(scene.pyramid(SE3()), {}, false);
  EXPECT_EQ(track(*scene.pyramid(SE3()), cloud, {SE3()}, AlignmentParams()).status, TrackingState::kLost);
}

// All edges parallel: motion along them is not observable, and the status must show it.
TEST(Track, ParallelEdgesAreReportedAsWeak) {
  const GrayImage stripes =
      test::make_image(320, 240, [](double x, double) { return 128 + 90 * std::sin(x / 6.0); });
  Camera camera;
  camera.pinhole = {260, 260, 159.5, 119.5, 320, 240};
  PyramidBuilder builder(camera, EdgeParams());
  const auto pyramid = builder.build(stripes);
  std::vector<CloudPoint> points;
  for (size_t i = 0; i < pyramid->finest().edges.pixels.size(); i += 4) {
    const EdgePixel& e = pyramid->finest().edges.pixels[i];
    points.push_back({camera.pinhole.ray(e.position().cast<double>()), 0.2, 0.001, e.position(), e.normal()});
  }
  const TrackResult r =
      track(*pyramid, make_reference_cloud(pyramid, points, false), {SE3()}, AlignmentParams());
  EXPECT_EQ(r.status, TrackingState::kDegraded);
  ASSERT_FALSE(r.weak_directions.empty());
  double along = 0;  // translation in y is among them
  for (const Vector6d& d : r.weak_directions) along = std::max(along, std::abs(d[1]));
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
