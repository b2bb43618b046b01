#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "edgevo/alignment/projection.h"
#include "edgevo/association/associate.h"
#include "edgevo/association/normal_refinement.h"
#include "edgevo/association/patch_cost.h"
#include "edgevo/association/uncertainty.h"
#include "edgevo/core/random.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

// ---- uncertainty, against Monte Carlo on a synthetic edge ----

struct SyntheticEdge {
  Pinhole camera{500, 500, 320, 240, 640, 480};
  SE3 T = SE3::exp(twist(0.3, 0.05, 0.1, 0.01, -0.02, 0.015));
  Eigen::Vector3d ray{0.2, -0.1, 1};
  double idepth = 0.4, idepth_sigma = 0.004;
  Matrix6d Sigma_xi;
  SyntheticEdge() {
    Random random(8);
    Matrix6d A;
    for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = 2e-4 * random.normal();
    Sigma_xi = A * A.transpose() + 1e-9 * Matrix6d::Identity();
  }
  Eigen::Vector2d px(const SE3& pose, double d) const {
    return project(camera, pose.R(), pose.translation(), ray, d).px;
  }
};

TEST(Uncertainty, ProjectionCovarianceMatchesMonteCarlo) {
  const SyntheticEdge s;
  const Projection at = project(s.camera, s.T.R(), s.T.translation(), s.ray, s.idepth);
  const Eigen::Matrix2d expected = projection_covariance(s.camera, at.Y, s.idepth, s.Sigma_xi);
  const Matrix6d L = s.Sigma_xi.llt().matrixL();
  Random random(1);
  Eigen::Matrix2d sampled = Eigen::Matrix2d::Zero();
  constexpr int kTrials = 20000;
  for (int t = 0; t < kTrials; ++t) {
    Vector6d z;
    for (int i = 0; i < 6; ++i) z[i] = random.normal();
    const Eigen::Vector2d d = s.px(SE3::exp(L * z) * s.T, s.idepth) - at.px;
    sampled += d * d.transpose() / kTrials;
  }
  EXPECT_LT((sampled - expected).norm(), 0.05 * expected.norm());
  for (double angle : {0.0, 0.7, 1.9}) {
    const Eigen::Vector2d a(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(sigma_along(expected, a), std::sqrt(a.dot(sampled * a)),
                0.05 * std::sqrt(a.dot(sampled * a)));
  }
}

// lambda is where the epipolar line of the perturbed point crosses the edge, Eq. (intersection): its spread
// along the edge must be sigma_lambda, and the search length must cover it.
TEST(Uncertainty, SearchLengthMatchesTheSpreadOfMatchesAlongTheEdge) {
  const SyntheticEdge s;
  const Projection at = project(s.camera, s.T.R(), s.T.translation(), s.ray, s.idepth);
  const Eigen::Matrix2d Sigma_p = projection_covariance(s.camera, at.Y, s.idepth, s.Sigma_xi);
  const DepthMotion depth = depth_motion(s.camera, s.T, s.ray, s.idepth, s.idepth_sigma);
  const Matrix6d L = s.Sigma_xi.llt().matrixL();
  for (double angle : {0.1, 0.8, 1.4, 2.3}) {
    const Eigen::Vector2d g(std::cos(angle), std::sin(angle)), g_perp(-g.y(), g.x());
    Random random(2);
    double square = 0;
    constexpr int kTrials = 20000;
    int covered = 0;
    const double half = search_half_length(Sigma_p, depth, g, 1, 1);
    for (int t = 0; t < kTrials; ++t) {
      Vector6d z;
      for (int i = 0; i < 6; ++i) z[i] = random.normal();
      // The true point, as the estimate's errors move it: its offset along the edge from the prediction.
      const Eigen::Vector2d d =
          s.px(SE3::exp(L * z) * s.T, s.idepth + s.idepth_sigma * random.normal()) - at.px;
      const double lambda = g_perp.dot(d);
      square += lambda * lambda / kTrials;
      covered += std::abs(lambda) <= half;
    }
    EXPECT_NEAR(std::sqrt(search_variance(Sigma_p, depth, g)), std::sqrt(square), 0.06 * std::sqrt(square))
        << angle;
    EXPECT_GE(half, 0.98 * std::sqrt(square))
        << "the sum bounds the root of squares, Eq. (uncertaintyseperation)";
    EXPECT_GT(double(covered) / kTrials, 0.66);
  }
}

// sigma_mu of Eq. (depthuncertainty): mu = e_(p||g) / cos theta, so its spread is sigma_(p||g) / |cos theta|
// = 1 / C_d.
TEST(Uncertainty, DepthConfidenceMatchesTheSpreadOfTheIntersection) {
  const SyntheticEdge s;
  const Projection at = project(s.camera, s.T.R(), s.T.translation(), s.ray, s.idepth);
  const Eigen::Matrix2d Sigma_p = projection_covariance(s.camera, at.Y, s.idepth, s.Sigma_xi);
  const Eigen::Vector2d l = depth_motion(s.camera, s.T, s.ray, s.idepth, s.idepth_sigma).direction;
  const Matrix6d L = s.Sigma_xi.llt().matrixL();
  for (double angle : {0.2, 0.9, 2.0}) {
    const Eigen::Vector2d g(std::cos(angle), std::sin(angle));
    Random random(4);
    double square = 0;
    constexpr int kTrials = 20000;
    for (int t = 0; t < kTrials; ++t) {
      Vector6d z;
      for (int i = 0; i < 6; ++i) z[i] = random.normal();
      const Eigen::Vector2d p = s.px(SE3::exp(L * z) * s.T, s.idepth);
      square += std::pow(g.dot(at.px - p) / g.dot(l), 2) / kTrials;  // Eq. (depth)
    }
    EXPECT_NEAR(depth_confidence(Sigma_p, l, g, 1e-9) * std::sqrt(square), 1.0, 0.06) << angle;
  }
}

TEST(Uncertainty, DepthMotionFollowsTheEpipolarLine) {
  const SyntheticEdge s;
  const DepthMotion m = depth_motion(s.camera, s.T, s.ray, s.idepth, s.idepth_sigma);
  const Eigen::Vector2d up = s.px(s.T, s.idepth + s.idepth_sigma) - s.px(s.T, s.idepth);
  const Eigen::Vector2d down = s.px(s.T, s.idepth - s.idepth_sigma) - s.px(s.T, s.idepth);
  EXPECT_NEAR(m.sigma_mu_px, std::max(up.norm(), down.norm()), 1e-12);
  EXPECT_GT(m.direction.dot(up.normalized()), 0.999);
  EXPECT_EQ(depth_motion(s.camera, SE3(), s.ray, s.idepth, s.idepth_sigma).sigma_mu_px, 0) << "no baseline";
}

// ---- AML ----

TEST(Aml, OneClearMinimumIsConfidentAndEqualCostsAreNot) {
  const double clear[] = {0.9, 0.8, 0.1, 0.8, 0.9}, flat[] = {0.1, 0.1, 0.1, 0.1, 0.1},
               two[] = {0.1, 0.9, 0.1, 0.9};
  EXPECT_NEAR(aml_confidence(clear, 5, 0.1, 0.08), 1.0, 1e-6);
  EXPECT_NEAR(aml_confidence(flat, 5, 0.1, 0.08), 0.2, 1e-12);
  EXPECT_NEAR(aml_confidence(two, 4, 0.1, 0.08), 0.5, 1e-6);
}

// With Gaussian cost noise, C_m is the attainable likelihood: among candidates whose true costs are known, a
// match with higher C_m is more often the right one.
TEST(Aml, RanksMatchesAsMonteCarloDoes) {
  Random random(6);
  int right_high = 0, n_high = 0, right_low = 0, n_low = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    double cost[9];
    const double contrast = random.uniform(0, 0.6);
    for (int i = 0; i < 9; ++i) cost[i] = contrast * std::abs(i - 4) / 4.0 + 0.05 * random.normal();
    const int best = int(std::min_element(cost, cost + 9) - cost);
    const bool confident = aml_confidence(cost, 9, cost[best], 0.08) >= 0.3;
    (confident ? n_high : n_low)++;
    (confident ? right_high : right_low) += std::abs(best - 4) <= 1;
  }
  ASSERT_GT(n_high, 1000);
  ASSERT_GT(n_low, 1000);
  EXPECT_GT(double(right_high) / n_high, double(right_low) / n_low + 0.2);
}

// ---- warps and patches ----

TEST(Warp, AgreesWithNumericDifferentiation) {
  const Pinhole camera{260, 250, 160, 120, 320, 240};
  const SE3 T = SE3::exp(twist(0.2, -0.1, 0.3, 0.05, -0.08, 0.2));
  const Eigen::Vector2d px(100, 80);
  const double idepth = 0.3;
  const auto map = [&](const Eigen::Vector2d& p) {
    return project(camera, T.R(), T.translation(), camera.ray(p), idepth).px;
  };
  const Eigen::Matrix2d A = patch_warp(camera, T, px, idepth);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d d = 1e-4 * Eigen::Vector2d::Unit(k);
    EXPECT_LT((A.col(k) - (map(px + d) - map(px - d)) / 2e-4).norm(), 1e-5);
  }
  // A normal stays perpendicular to the warped edge.
  const Eigen::Vector2d n = Eigen::Vector2d(0.3, -0.9).normalized(), along(-n.y(), n.x());
  EXPECT_NEAR(warp_normal(A, n).dot(A * along), 0, 1e-12);
  EXPECT_GT(warp_normal(A, n).dot(A * n), 0);
}

TEST(PatchCost, IgnoresGainAndTellsPlacesApart) {
  const GrayImage image = test::textured_image(120, 90, 4);
  const Gradient gradient = compute_gradient(image.view());
  GrayImage dark = image;
  for (uint8_t& v : dark.pixels) v = uint8_t(0.5 * v);
  const Gradient dark_gradient = compute_gradient(dark.view());
  Patch patch;
  ASSERT_TRUE(sample_patch(gradient.magnitude.view(), 60, 45, 2, &patch));
  ASSERT_TRUE(divide_by_mean(&patch));
  EXPECT_NEAR(patch_cost(patch, gradient.magnitude.view(), 60, 45), 0, 1e-6);
  EXPECT_LT(patch_cost(patch, dark_gradient.magnitude.view(), 60, 45), 0.1);
  EXPECT_GT(patch_cost(patch, gradient.magnitude.view(), 52, 40), 0.15);
  EXPECT_EQ(patch_cost(patch, gradient.magnitude.view(), 1, 45), 2.0);
}

TEST(NormalRefinement, FindsASubPixelShiftAlongTheNormal) {
  const test::Texture texture(17);
  for (double shift : {-1.3, -0.4, 0.0, 0.27, 0.9}) {
    const Eigen::Vector2d normal = Eigen::Vector2d(0.8, 0.6);
    const GrayImage host = test::make_image(100, 80, [&](double x, double y) { return texture.at({x, y}); });
    const GrayImage target = test::make_image(100, 80, [&](double x, double y) {
      return 0.7 * texture.at(Eigen::Vector2d(x, y) - shift * normal) + 15;
    });
    NormalTemplate patch;
    ASSERT_TRUE(make_normal_template(host.view(), {50, 40}, Eigen::Matrix2d::Identity(), normal, 4, &patch));
    const NormalRefinement r = refine_along_normal(patch, target.view(), {50, 40}, normal);
    ASSERT_TRUE(r.accepted) << shift;
    EXPECT_NEAR(r.move_px, shift, 0.04);
    EXPECT_LT(r.zncc_loss, 0.02);
  }
}

TEST(NormalRefinement, RefusesAnUnrelatedPlaceAndFlatPatches) {
  const GrayImage host = test::textured_image(100, 80, 17), other = test::textured_image(100, 80, 18);
  const GrayImage flat{100, 80, std::vector<uint8_t>(8000, 77)};
  const Eigen::Vector2d normal(1, 0);
  NormalTemplate patch;
  EXPECT_FALSE(make_normal_template(flat.view(), {50, 40}, Eigen::Matrix2d::Identity(), normal, 4, &patch));
  EXPECT_FALSE(make_normal_template(host.view(), {2, 40}, Eigen::Matrix2d::Identity(), normal, 4, &patch));
  ASSERT_TRUE(make_normal_template(host.view(), {50, 40}, Eigen::Matrix2d::Identity(), normal, 4, &patch));
  EXPECT_FALSE(refine_along_normal(patch, other.view(), {50, 40}, normal).accepted);
  EXPECT_FALSE(refine_along_normal(patch, flat.view(), {50, 40}, normal).accepted);
}

// The slope of the template is the derivative of the warped patch along the normal.
TEST(NormalRefinement, SlopeIsTheDerivativeOfTheDifference) {
  const GrayImage image = test::textured_image(100, 80, 17);
  const Eigen::Vector2d normal(0.8, 0.6), at(50, 40);
  NormalTemplate patch;
  ASSERT_TRUE(make_normal_template(image.view(), at, Eigen::Matrix2d::Identity(), normal, 4, &patch));
  const auto difference =
      [&](double move) {  // half the squared difference to the image moved along the normal
        Patch current;
        EXPECT_TRUE(
            sample_patch(image.view(), at.x() + move * normal.x(), at.y() + move * normal.y(), 4, &current));
        EXPECT_GT(normalise(&current, 1.0f), 0);
        double sum = 0;
        for (int i = 0; i < current.size(); ++i)
          sum += 0.5 * std::pow(current.value[i] - patch.value.value[i], 2);
        return sum;
      };
  // At small moves the difference is slope_square move^2 / 2: its second derivative is slope_square.
  constexpr double kStep = 0.25;
  const double numeric = (difference(kStep) - 2 * difference(0) + difference(-kStep)) / (kStep * kStep);
  EXPECT_NEAR(numeric / patch.slope_square, 1.0, 0.35)
      << "bilinear sampling between pixels blurs, which adds to the difference";
}

// ---- the pipeline on a rendered plane ----

struct Outcome {
  int tried = 0, matched = 0, photometric = 0;
  double normal_rms = 0, tangent_rms = 0;
};

Outcome associate_all(const AssociationParams& params, double gain, double idepth_error) {
  const test::PlaneScene scene;
  const SE3 T_target_host = SE3::exp(twist(0.25, 0.05, 0.1, 0.01, -0.02, 0.03));
  const auto host = scene.pyramid(SE3()), target = scene.pyramid(T_target_host.inverse(), gain, 10);
  Outcome o;
  double normal_square = 0, tangent_square = 0;
  const auto& pixels = host->finest().edges.pixels;
  for (size_t i = 0; i < pixels.size(); i += 7) {
    AssociationQuery q;
    q.host = host.get(), q.target = target.get();
    q.px_host = pixels[i].position().cast<double>();
    q.normal_host = pixels[i].normal().cast<double>();
    const double truth = scene.idepth(SE3(), q.px_host);
    q.idepth = truth * (1 + idepth_error);
    q.idepth_sigma = std::max(0.01, std::abs(idepth_error)) * truth;
    q.T_target_host = T_target_host;
    q.pose_covariance = 1e-8 * Matrix6d::Identity();
    ++o.tried;
    const Match m = associate(q, params);
    if (m.kind == MatchKind::kNone) continue;
    ++o.matched;
    const Eigen::Vector2d exact =
        project(scene.camera.pinhole, T_target_host.R(), T_target_host.translation(),
                scene.camera.pinhole.ray(q.px_host), truth)
            .px;
    const Eigen::Vector2d d = m.px - exact;
    normal_square += std::pow(m.normal.dot(d), 2);
    EXPECT_GE(m.match_confidence, 0);
    EXPECT_LE(m.match_confidence, 1);
    EXPECT_GT(m.inv_sigma_normal, 0);
    if (m.kind != MatchKind::kPhotometric) continue;
    ++o.photometric;
    tangent_square += std::pow(m.normal.x() * d.y() - m.normal.y() * d.x(), 2);
  }
  o.normal_rms = std::sqrt(normal_square / std::max(1, o.matched));
  o.tangent_rms = std::sqrt(tangent_square / std::max(1, o.photometric));
  return o;
}

TEST(Associate, FindsTheExactMatches) {
  const Outcome o = associate_all(AssociationParams(), 1.0, 0.0);
  EXPECT_GT(o.matched, 0.75 * o.tried);
  EXPECT_GT(o.photometric, 0.3 * o.tried);
  EXPECT_LT(o.normal_rms, 0.2);
  EXPECT_LT(o.tangent_rms, 1.0);
}

TEST(Associate, RefinementSharpensTheNormalPosition) {
  AssociationParams with, without;
  with.refine = true, without.refine = false;
  const Outcome a = associate_all(with, 1.0, 0.02), b = associate_all(without, 1.0, 0.02);
  EXPECT_LT(a.normal_rms, b.normal_rms);
}

TEST(Associate, HoldsWhenTheLightChanges) {
  const Outcome normal = associate_all(AssociationParams(), 1.0, 0.0),
                dark = associate_all(AssociationParams(), 0.5, 0.0);
  EXPECT_GT(dark.matched, 0.85 * normal.matched);
  EXPECT_LT(dark.normal_rms, 0.2);
}

TEST(Associate, OffGivesEdgeMatchesOnly) {
  AssociationParams params;
  params.photometric = false;
  const Outcome o = associate_all(params, 1.0, 0.0);
  EXPECT_EQ(o.photometric, 0);
  EXPECT_GT(o.matched, 0.7 * o.tried);
}

// A first patch larger than the largest one is searched with all the same: it does not grow.
TEST(Associate, AFirstPatchBeyondTheLargestOneDoesNotGrow) {
  AssociationParams one_size, beyond;
  one_size.patch_side = one_size.max_patch_side = beyond.patch_side = 9;
  beyond.max_patch_side = 5;
  const Outcome a = associate_all(one_size, 1.0, 0.0), b = associate_all(beyond, 1.0, 0.0);
  EXPECT_GT(a.photometric, 0);
  EXPECT_EQ(a.photometric, b.photometric);
}

TEST(Associate, APointBehindTheCameraOrOutsideHasNoMatch) {
  const test::PlaneScene scene;
  const auto host = scene.pyramid(SE3());
  AssociationQuery q;
  q.host = q.target = host.get();
  q.px_host = {160, 120};
  q.normal_host = {1, 0};
  q.idepth = 0.2, q.idepth_sigma = 0.01;
  q.pose_covariance = 1e-8 * Matrix6d::Identity();
  q.T_target_host = SE3(Eigen::Quaterniond::Identity(), {0, 0, -9});
  EXPECT_EQ(associate(q, AssociationParams()).kind, MatchKind::kNone);
  q.T_target_host = SE3(Eigen::Quaterniond::Identity(), {50, 0, 0});
  EXPECT_EQ(associate(q, AssociationParams()).kind, MatchKind::kNone);
}

TEST(NeedsUpdate, FollowsTheDistanceCheck) {
  AssociationParams params;
  Match m;
  m.search_px = 4, m.inv_sigma_normal = 2;
  EXPECT_FALSE(needs_update(m, 0.5, 2.9, params));
  EXPECT_TRUE(needs_update(m, 0.5, -3.1, params)) << "|e| > k_m lambda, k_m = 0.75";
  EXPECT_TRUE(needs_update(m, -1.8, 0, params)) << "beyond 3.5 sigma along the normal";
}

}  // namespace
}  // namespace edgevo
