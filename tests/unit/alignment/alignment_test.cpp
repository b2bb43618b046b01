#include <gtest/gtest.h>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/alignment/projection.h"
#include "edgevo/alignment/tracker.h"
#include "edgevo/core/random.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

double rotation_error_deg(const SE3& a, const SE3& b) { return (a * b.inverse()).angle() * 180 / M_PI; }

// ---- Jacobians against numeric differentiation ----

TEST(Projection, PoseJacobianIsThatOfTheLeftPerturbation) {
  const Pinhole camera{520, 510, 320, 240, 640, 480};
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    Vector6d xi;
    for (int i = 0; i < 6; ++i) xi[i] = 0.3 * random.normal();
    const SE3 T = SE3::exp(xi);
    const Eigen::Vector3d ray(random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5), 1);
    const double idepth = random.uniform(0.1, 0.8);
    const Projection at = project(camera, T.R(), T.translation(), ray, idepth);
    if (!at.valid || at.Y.z() < 0.2) continue;
    const Eigen::Matrix<double, 2, 6> J = pose_jacobian(camera, at.Y, idepth);
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 6; ++k) {
      Vector6d d = Vector6d::Zero();
      d[k] = kStep;
      const SE3 plus = SE3::exp(d) * T, minus = SE3::exp(-d) * T;
      const Eigen::Vector2d numeric = (project(camera, plus.R(), plus.translation(), ray, idepth).px -
                                       project(camera, minus.R(), minus.translation(), ray, idepth).px) /
                                      (2 * kStep);
      EXPECT_LT((J.col(k) - numeric).norm(), 1e-6 * (1 + numeric.norm())) << k;
    }
  }
}

TEST(Projection, JacobianOfTheProjection) {
  const Pinhole camera{520, 510, 320, 240, 640, 480};
  const Eigen::Vector3d Y(0.3, -0.2, 1.4);
  const auto J = projection_jacobian(camera, Y);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d d = 1e-6 * Eigen::Vector3d::Unit(k);
    const Eigen::Vector2d numeric = (camera.project(Y + d) - camera.project(Y - d)) / 2e-6;
    EXPECT_LT((J.col(k) - numeric).norm(), 1e-5);
  }
}

TEST(EdgeAlignment, ResidualJacobian) {
  const Pinhole camera{520, 510, 320, 240, 640, 480};
  const SE3 T = SE3::exp(twist(0.1, -0.05, 0.2, 0.02, 0.03, -0.04));
  const Eigen::Vector3d ray(0.2, -0.1, 1);
  const Eigen::Vector2d match(400, 200), normal = Eigen::Vector2d(0.6, -0.8);
  const EdgeResidual at = edge_residual(camera, T, ray, 0.4, match, normal);
  for (int k = 0; k < 6; ++k) {
    Vector6d d = Vector6d::Zero();
    d[k] = 1e-6;
    const double numeric = (edge_residual(camera, SE3::exp(d) * T, ray, 0.4, match, normal).value -
                            edge_residual(camera, SE3::exp(-d) * T, ray, 0.4, match, normal).value) /
                           2e-6;
    EXPECT_NEAR(at.jacobian[k], numeric, 1e-5 * (1 + std::abs(numeric)));
  }
}

// Centre of the patch with the strongest contrast: there the rounding to gray levels does not count.
Eigen::Vector2f contrasting_place(const GrayImage& image) {
  Eigen::Vector2f best(10, 10);
  int most = -1;
  for (int y = 10; y < image.height - 10; ++y)
    for (int x = 10; x < image.width - 10; ++x) {
      const auto at = [&](int u, int v) { return int(image.pixels[size_t(v) * image.width + u]); };
      const int contrast = std::abs(at(x - 2, y) - at(x + 2, y)) + std::abs(at(x, y - 2) - at(x, y + 2));
      if (contrast > most) most = contrast, best = {float(x), float(y)};
    }
  return best;
}

// The patch gradient is that of the difference itself, for a shift of the patch; template and image are the
// same here, so that the template's slope is also the image's.
TEST(PatchTemplate, GradientAgainstNumericShift) {
  const GrayImage image = test::textured_image(80, 60, 21);
  const Eigen::Vector2f at = contrasting_place(image);
  const PatchTemplates patches = cut_patches(image.view(), {at});
  ASSERT_TRUE(patches[0].usable);
  for (const Eigen::Vector2f& shift :
       {Eigen::Vector2f(0.2f, 0.0f), Eigen::Vector2f(0.0f, -0.2f), Eigen::Vector2f(0.15f, 0.1f)}) {
    const auto cost = [&](double dx, double dy) {
      const Eigen::Vector2f p = at + shift + Eigen::Vector2f(float(dx), float(dy));
      return 0.5 * compare_patch(image.view(), patches[0], p.x(), p.y()).mean_square;
    };
    const PatchDifference d = compare_patch(image.view(), patches[0], at.x() + shift.x(), at.y() + shift.y());
    const Eigen::Vector2d numeric((cost(0.05, 0) - cost(-0.05, 0)) / 0.1,
                                  (cost(0, 0.05) - cost(0, -0.05)) / 0.1);
    EXPECT_LT((d.gradient - numeric).norm(), 0.3 * numeric.norm() + 3e-3);
  }
}

TEST(PatchTemplate, GainAndOffsetCancel) {
  GrayImage image = test::textured_image(80, 60, 21);
  const Eigen::Vector2f at = contrasting_place(image);
  const PatchTemplates patches = cut_patches(image.view(), {at});
  for (uint8_t& v : image.pixels) v = uint8_t(0.5 * v + 20);
  EXPECT_LT(compare_patch(image.view(), patches[0], at.x(), at.y()).mean_square, 1e-3);
}

TEST(PatchTemplate, OutsideAndFlatPatchesAreUnusable) {
  const GrayImage flat{40, 30, std::vector<uint8_t>(1200, 99)};
  const GrayImage image = test::textured_image(40, 30, 21);
  EXPECT_FALSE(cut_patches(flat.view(), {{20.0f, 15.0f}})[0].usable);
  EXPECT_FALSE(cut_patches(image.view(), {{1.0f, 15.0f}})[0].usable);
  const PatchTemplates patches = cut_patches(image.view(), {{20.0f, 15.0f}});
  EXPECT_FALSE(compare_patch(image.view(), patches[0], 38.5f, 15.0f).usable);
  EXPECT_FALSE(compare_patch(image.view(), patches[0], std::nanf(""), 15.0f).usable);
}

// ---- perturb and recover ----

class TrackTest : public ::testing::TestWithParam<Vector6d> {};

TEST_P(TrackTest, FindsThePoseFromTheReferencePose) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(GetParam());
  const ReferenceCloud cloud = scene.cloud(SE3());
  ASSERT_GT(cloud.points.size(), 300u);
  const TrackResult r = track(*scene.pyramid(T_cur_ref.inverse()), cloud, {SE3()}, AlignmentParams());
  EXPECT_EQ(r.verdict, TrackingState::kTracking) << r.reason;
  EXPECT_GT(r.evidence.inlier_share, 0.8);
  // Before a plane, turning and moving sideways look much alike: 0.06 degrees and 6 mm together move the
  // points by 0.06 pixels.
  EXPECT_LT(rotation_error_deg(r.T_cur_ref, T_cur_ref), 0.08);
  EXPECT_LT((r.T_cur_ref.translation() - T_cur_ref.translation()).norm(), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Motions, TrackTest,
                         ::testing::Values(Vector6d::Zero(), twist(0.1, 0, 0, 0, 0, 0),
                                           twist(0, 0, 0.2, 0, 0, 0), twist(0, 0, 0, 0, 0.04, 0),
                                           twist(0, 0, 0, 0, 0, 0.06),
                                           twist(0.1, -0.08, 0.15, 0.02, -0.03, 0.02)));

// A tight prior keeps the translation where it is expected, a wide one leaves it to the image.
TEST(Align, NearAnExpectedPlace) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.02, 0, 0.05, 0, 0, 0)),
            T_expected = SE3::exp(twist(0.02, 0, 0.01, 0, 0, 0));
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto pyramid = scene.pyramid(T_cur_ref.inverse());
  const auto error = [&](double sigma, const SE3& T) {
    const PoseHypothesis near{T_expected, PoseHypothesis::Refinement::kEdges,
                              Eigen::Vector3d::Constant(sigma)};
    const PoseCandidate r = align(*pyramid, cloud, near, AlignmentParams());
    EXPECT_TRUE(PoseJudge(AlignmentParams()).fits(r));
    return (r.T_cur_ref.translation() - T.translation()).norm();
  };
  EXPECT_LT(error(1e-5, T_expected), 0.003);
  EXPECT_LT(error(10, T_cur_ref), 0.01);
}

TEST(Track, HoldsUnderAnExposureJump) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.08, 0.02, 0.1, 0.01, -0.02, 0.01));
  const TrackResult r =
      track(*scene.pyramid(T_cur_ref.inverse(), 0.5, 30), scene.cloud(SE3()), {SE3()}, AlignmentParams());
  EXPECT_EQ(r.verdict, TrackingState::kTracking) << r.reason;
  EXPECT_LT(rotation_error_deg(r.T_cur_ref, T_cur_ref), 0.08);
}

TEST(Track, TriesOtherStartsWhenTheFirstIsBad) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.05, 0, 0, 0, 0.01, 0));
  const SE3 bad = SE3::exp(twist(0, 0, 0, 0, 0.9, 0));
  const TrackResult r =
      track(*scene.pyramid(T_cur_ref.inverse()), scene.cloud(SE3()), {bad, SE3()}, AlignmentParams());
  EXPECT_EQ(r.verdict, TrackingState::kTracking) << r.reason;
}

// Rotation and direction known, the length wrong by half: the edges find it.
TEST(Align, AlongAKnownDirectionTheEdgesFindTheLength) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.25, 0.05, 0.3, 0.02, -0.03, 0.01));
  for (const double length : {0.55, 1.0, 1.9}) {
    const SE3 guess(T_cur_ref.rotation(), length * T_cur_ref.translation());
    const PoseHypothesis along{guess, PoseHypothesis::Refinement::kLengthThenEdges};
    const PoseCandidate r =
        align(*scene.pyramid(T_cur_ref.inverse()), scene.cloud(SE3()), along, AlignmentParams());
    EXPECT_TRUE(PoseJudge(AlignmentParams()).fits(r));
    EXPECT_LT((r.T_cur_ref.translation() - T_cur_ref.translation()).norm(),
              0.02 * T_cur_ref.translation().norm())
        << length;
    EXPECT_LT(rotation_error_deg(r.T_cur_ref, T_cur_ref), 0.1);
  }
}

TEST(Track, PhotometricCostAgreesWithTheTruth) {
  const test::PlaneScene scene;
  AlignmentParams params;
  params.photometric = true;
  const SE3 T_cur_ref = SE3::exp(twist(0.08, 0.02, 0.1, 0.01, -0.02, 0.01));
  const TrackResult r =
      track(*scene.pyramid(T_cur_ref.inverse()), scene.cloud(SE3(), 4, true), {SE3()}, params);
  EXPECT_LT(rotation_error_deg(r.T_cur_ref, T_cur_ref), 0.05);
  EXPECT_LT((r.T_cur_ref.translation() - T_cur_ref.translation()).norm(), 0.01);
}

// Gray levels on the coarse levels that belong to another place, as those of shadows and glare do; the edges
// are those of the scene.
TEST(Align, EdgesOverruleMisledGrayLevels) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.05, 0, 0.05, 0, 0.01, 0)),
            elsewhere = SE3::exp(twist(0.4, 0, 0.05, 0, 0.04, 0));
  const auto frame = std::const_pointer_cast<FramePyramid>(scene.pyramid(T_cur_ref.inverse()));
  const auto misled = std::const_pointer_cast<FramePyramid>(scene.pyramid(elsewhere.inverse()));
  for (size_t level = 1; level < frame->levels.size(); ++level)
    std::swap(frame->levels[level].gray, misled->levels[level].gray);
  const FramePyramid& current = *frame;
  const ReferenceCloud cloud = scene.cloud(SE3());
  SE3 by_patches = T_cur_ref;
  align_patches(current, cloud, int(current.levels.size()) - 1, 1, &by_patches);
  for (int level : {1, 0}) align_edges(current, cloud, level, AlignmentParams(), &by_patches);
  ASSERT_GT((by_patches.translation() - T_cur_ref.translation()).norm(), 0.1)
      << "what comes of following them";
  const PoseCandidate found = align(current, cloud, {T_cur_ref}, AlignmentParams());
  EXPECT_LT((found.T_cur_ref.translation() - T_cur_ref.translation()).norm(), 0.01);
}

// Points that leave the view must not hold the camera back, nor may a pose win by pushing them out.
TEST(EdgeAlignment, APointOutOfViewCostsHalfAMiss) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto there = scene.pyramid(SE3());
  const AlignmentParams params;
  const double none_in_view = edge_cost(*there, cloud, 0, params, SE3::exp(twist(0, 0, 0, 0, 2, 0)));
  EXPECT_LT(edge_cost(*there, cloud, 0, params, SE3()), 0.2 * none_in_view);
  // Nothing matches in a black image: each point in view costs a miss.
  EXPECT_NEAR(edge_cost(*scene.pyramid(SE3(), 0.0, 0.0), cloud, 0, params, SE3()), 2 * none_in_view,
              0.05 * none_in_view);
}

TEST(Track, BlackImageIsLostWithAReason) {
  const test::PlaneScene scene;
  const TrackResult r =
      track(*scene.pyramid(SE3(), 0.0, 0.0), scene.cloud(SE3()), {SE3()}, AlignmentParams());
  EXPECT_EQ(r.verdict, TrackingState::kLost);
  EXPECT_FALSE(r.reason.empty());
}

TEST(Track, AnotherSceneIsNotTracked) {
  const test::PlaneScene scene(11), other(99);
  const TrackResult r = track(*other.pyramid(SE3()), scene.cloud(SE3()), {SE3()}, AlignmentParams());
  EXPECT_EQ(r.verdict, TrackingState::kLost) << r.evidence.inlier_share;
}

TEST(Track, EmptyCloudIsLost) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = make_reference_cloud(scene.pyramid(SE3()), {}, false);
  EXPECT_EQ(track(*scene.pyramid(SE3()), cloud, {SE3()}, AlignmentParams()).verdict, TrackingState::kLost);
}

// All edges parallel: motion along them cannot be seen, and the verdict must say so.
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
  EXPECT_EQ(r.verdict, TrackingState::kDegraded);
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
