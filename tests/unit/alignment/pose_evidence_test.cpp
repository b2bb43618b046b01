// SPDX-License-Identifier: BSD-3-Clause
// Which points support a pose.
#include "edgevo/alignment/pose_evidence.h"

#include <gtest/gtest.h>

#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

TEST(PoseEvidence, NearlyAllPointsSupportTheTruePoseAndFewAnother) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.1, 0, 0.1, 0.01, -0.02, 0));
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto current = scene.pyramid(T_cur_ref.inverse());
  const AlignmentParams params;
  EXPECT_GT(weigh_evidence(*current, cloud, T_cur_ref, params).inlier_share, 0.85);
  EXPECT_LT(weigh_evidence(*current, cloud, SE3::exp(twist(0, 0, 0, 0.08, 0.1, 0)) * T_cur_ref, params)
                .inlier_share,
            0.15);
}

TEST(PoseEvidence, DoesNotDependOnExposure) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.1, 0, 0.1, 0.01, -0.02, 0));
  const ReferenceCloud cloud = scene.cloud(SE3());
  const AlignmentParams params;
  const double bright =
      weigh_evidence(*scene.pyramid(T_cur_ref.inverse()), cloud, T_cur_ref, params).inlier_share;
  const double dark =
      weigh_evidence(*scene.pyramid(T_cur_ref.inverse(), 0.3, 10), cloud, T_cur_ref, params).inlier_share;
  EXPECT_NEAR(dark, bright, 0.05);
}

// A point that may lie anywhere cannot contradict a pose; under pure rotation its depth does not matter.
TEST(PoseEvidence, PointsOfUnknownDepthAreNoEvidenceUnderTranslation) {
  const test::PlaneScene scene;
  ReferenceCloud cloud = scene.cloud(SE3());
  const size_t known = cloud.points.size() / 2;
  for (size_t i = known; i < cloud.points.size(); ++i) {
    cloud.points[i].idepth *= 3;  // wrong, and known to be uncertain
    cloud.points[i].idepth_sigma = 2 * cloud.points[i].idepth;
  }
  const AlignmentParams params;
  const SE3 moved = SE3::exp(twist(0.15, 0.1, 0, 0, 0, 0)), turned = SE3::exp(twist(0, 0, 0, 0.02, 0.03, 0));
  const PoseEvidence with_translation = weigh_evidence(*scene.pyramid(moved.inverse()), cloud, moved, params);
  EXPECT_GT(with_translation.inlier_share, 0.8);
  EXPECT_LT(with_translation.weight, 1.2 * double(known));
  const PoseEvidence with_rotation = weigh_evidence(*scene.pyramid(turned.inverse()), cloud, turned, params);
  EXPECT_GT(with_rotation.inlier_share, 0.85);
  EXPECT_GT(with_rotation.weight, 1.5 * double(known));
}

TEST(PoseEvidence, AnEmptyCloudIsNoEvidence) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = make_reference_cloud(scene.pyramid(SE3()), {}, false);
  const PoseEvidence evidence = weigh_evidence(*scene.pyramid(SE3()), cloud, SE3(), AlignmentParams());
  EXPECT_EQ(evidence.weight, 0);
  EXPECT_EQ(evidence.inlier_share, 0);
}

}  // namespace
}  // namespace edgevo
