// SPDX-License-Identifier: BSD-3-Clause
// The association pipeline on a rendered plane.
#include "edgevo/association/associate.h"

#include <gtest/gtest.h>

#include "edgevo/alignment/projection.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

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
        project(scene.camera.pinhole(), T_target_host.R(), T_target_host.translation(),
                scene.camera.pinhole().ray(q.px_host), truth)
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

TEST(Associate, WithoutPhotometricSearchGivesEdgeMatchesOnly) {
  AssociationParams params;
  params.photometric = false;
  const Outcome o = associate_all(params, 1.0, 0.0);
  EXPECT_EQ(o.photometric, 0);
  EXPECT_GT(o.matched, 0.7 * o.tried);
}

// A first patch larger than the largest one is used as it is; it does not grow.
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
