// SPDX-License-Identifier: BSD-3-Clause
// ATE and the block-wise re-scaling, against an independent computation: Horn's quaternion solution for the
// rotation, the scale from its own least-squares condition, and the blocks written out by their
// definition.
#include "edgevo/evaluation/absolute_error.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/synthetic_trajectory.h"

namespace edgevo {
namespace {

using test::some_similarity;

// Largest eigenvector of Horn's 4x4 matrix for the correlation sum src dst^T.
Eigen::Matrix3d horn_rotation(const Eigen::Matrix3d& M) {
  Eigen::Matrix4d N;
  N << M(0, 0) + M(1, 1) + M(2, 2), M(1, 2) - M(2, 1), M(2, 0) - M(0, 2), M(0, 1) - M(1, 0),
      M(1, 2) - M(2, 1), M(0, 0) - M(1, 1) - M(2, 2), M(0, 1) + M(1, 0), M(2, 0) + M(0, 2), M(2, 0) - M(0, 2),
      M(0, 1) + M(1, 0), -M(0, 0) + M(1, 1) - M(2, 2), M(1, 2) + M(2, 1), M(0, 1) - M(1, 0),
      M(2, 0) + M(0, 2), M(1, 2) + M(2, 1), -M(0, 0) - M(1, 1) + M(2, 2);
  const Eigen::Vector4d q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(N).eigenvectors().col(3);
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

struct BruteFit {
  double scale, rmse;
};

BruteFit brute_fit(const std::vector<Eigen::Vector3d>& src, const std::vector<Eigen::Vector3d>& dst,
                   bool with_scale) {
  Eigen::Vector3d mean_src = Eigen::Vector3d::Zero(), mean_dst = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < src.size(); ++i)
    mean_src += src[i] / double(src.size()), mean_dst += dst[i] / double(src.size());
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < src.size(); ++i) M += (src[i] - mean_src) * (dst[i] - mean_dst).transpose();
  const Eigen::Matrix3d R = horn_rotation(M);
  double product = 0, square = 0, error = 0;
  for (size_t i = 0; i < src.size(); ++i) {
    product += (dst[i] - mean_dst).dot(R * (src[i] - mean_src));
    square += (src[i] - mean_src).squaredNorm();
  }
  const double scale = with_scale ? product / square : 1.0;
  for (size_t i = 0; i < src.size(); ++i)
    error += (scale * (R * (src[i] - mean_src)) - (dst[i] - mean_dst)).squaredNorm();
  return {scale, std::sqrt(error / double(src.size()))};
}

BruteFit brute_ate(const std::vector<MatchedPose>& matches, bool with_scale) {
  std::vector<Eigen::Vector3d> est, gt;
  for (const MatchedPose& m : matches)
    est.push_back(m.T_est.translation()), gt.push_back(m.T_gt.translation());
  return brute_fit(est, gt, with_scale);
}

double brute_ate_blocks(const std::vector<MatchedPose>& matches, int block) {
  std::vector<Eigen::Vector3d> chained{Eigen::Vector3d::Zero()}, gt{matches[0].T_gt.translation()};
  for (size_t k = 1; k < matches.size(); ++k) {
    std::vector<MatchedPose> own;
    for (const MatchedPose& m : matches)
      if (m.frame / block == matches[k - 1].frame / block) own.push_back(m);
    const double scale = brute_ate(own, true).scale;
    chained.push_back(chained.back() +
                      scale * (matches[k].T_est.translation() - matches[k - 1].T_est.translation()));
    gt.push_back(matches[k].T_gt.translation());
  }
  return brute_fit(chained, gt, false).rmse;
}

std::vector<MatchedPose> match(const Trajectory& est, const Trajectory& gt) {
  return match_by_time(est, gt, test::frames_of(gt)).matches;
}

// An estimate whose unit grows by half over the run, with noise.
std::vector<MatchedPose> growing_scale(int frames) {
  const Trajectory truth = test::winding_drive(frames);
  Trajectory est = test::with_noise(test::seen_through(some_similarity(), truth), 0.02, 3);
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  const Trajectory before = est;
  for (size_t i = 1; i < est.poses.size(); ++i) {
    const double growth = 1.0 + 0.5 * double(i) / frames;
    position +=
        growth * (before.poses[i].T_world_cam.translation() - before.poses[i - 1].T_world_cam.translation());
    est.poses[i].T_world_cam = SE3(before.poses[i].T_world_cam.rotation(), position);
  }
  est.poses[0].T_world_cam = SE3(before.poses[0].T_world_cam.rotation(), Eigen::Vector3d::Zero());
  return match(est, truth);
}

TEST(AbsoluteError, IsZeroForTheTruthUnderASimilarity) {
  const Trajectory truth = test::winding_drive(300);
  const auto e = ate_sim3(match(test::seen_through(some_similarity(), truth), truth));
  ASSERT_TRUE(e);
  EXPECT_LT(e->rmse, 1e-9);
  EXPECT_NEAR(e->scale, some_similarity().scale, 1e-10);
  EXPECT_EQ(e->poses, 300);
}

TEST(AbsoluteError, AgreesWithHornsSolution) {
  const std::vector<MatchedPose> matches = growing_scale(300);
  EXPECT_NEAR(ate_sim3(matches)->rmse, brute_ate(matches, true).rmse, 1e-9);
  EXPECT_NEAR(ate_sim3(matches)->scale, brute_ate(matches, true).scale, 1e-9);
  EXPECT_NEAR(ate_se3(matches)->rmse, brute_ate(matches, false).rmse, 1e-9);
  EXPECT_GT(ate_sim3(matches)->rmse, 1.0);  // there is something to measure
}

TEST(AbsoluteError, StatisticsOfKnownDistances) {
  // Symmetric about the mean and along the line, so that the rigid fit is the identity: distances 1, 0, 0, 1.
  std::vector<MatchedPose> m(4);
  for (int i = 0; i < 4; ++i)
    m[size_t(i)].T_gt = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 10 * i));
  const double offset[] = {-1, 0, 0, 1};
  for (int i = 0; i < 4; ++i)
    m[size_t(i)].T_est = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 10 * i + offset[i]));
  const AbsoluteError e = *ate_se3(m);
  EXPECT_NEAR(e.rmse, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(e.mean, 0.5, 1e-12);
  EXPECT_NEAR(e.median, 0.5, 1e-12);
  EXPECT_NEAR(e.max, 1.0, 1e-12);
}

TEST(AbsoluteError, StraightLine) {
  const Trajectory truth = test::straight_drive(100);
  const auto matches = match(test::seen_through(some_similarity(), truth), truth);
  EXPECT_LT(ate_sim3(matches)->rmse, 1e-9);
  EXPECT_LT(ate_se3(rescale_blocks(matches, 30, 1.0))->rmse, 1e-9);
}

TEST(RescaleBlocks, AgreesWithItsDefinition) {
  const std::vector<MatchedPose> matches = growing_scale(700);
  for (int block : {200, 50, 1000}) {
    const double ours = ate_se3(rescale_blocks(matches, block, 1.0))->rmse;
    EXPECT_NEAR(ours, brute_ate_blocks(matches, block), 1e-8) << block;
  }
}

TEST(RescaleBlocks, UndoesAScaleThatJumpsAtTheBlocks) {
  const Trajectory truth = test::winding_drive(600);
  std::vector<MatchedPose> matches = match(truth, truth);
  const double units[] = {0.5, 2.0, 7.0};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (size_t i = 1; i < matches.size(); ++i) {
    position += units[(i - 1) / 200] *
                (truth.poses[i].T_world_cam.translation() - truth.poses[i - 1].T_world_cam.translation());
    matches[i].T_est = SE3(matches[i].T_est.rotation(), position);
  }
  EXPECT_GT(ate_sim3(matches)->rmse, 1.0);
  EXPECT_LT(ate_se3(rescale_blocks(matches, 200, 1.0))->rmse, 1e-9);
}

TEST(RescaleBlocks, BlocksCountInputFramesNotPoses) {
  std::vector<MatchedPose> matches = growing_scale(400);
  matches.erase(matches.begin() + 20, matches.begin() + 180);  // 160 frames without pose in block 0
  EXPECT_NEAR(ate_se3(rescale_blocks(matches, 200, 1.0))->rmse, brute_ate_blocks(matches, 200), 1e-8);
}

TEST(RescaleBlocks, ABlockOfTwoPosesTakesTheRatioOfPathLengths) {
  std::vector<MatchedPose> m(5);
  const double z_gt[] = {0, 1, 2, 3, 9}, z_est[] = {0, 2, 4, 6, 8};
  const int frame[] = {0, 1, 2, 10, 11};
  for (int i = 0; i < 5; ++i) {
    m[size_t(i)].frame = frame[i];
    m[size_t(i)].T_gt = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, z_gt[i]));
    m[size_t(i)].T_est = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, z_est[i]));
  }
  const std::vector<MatchedPose> r = rescale_blocks(m, 10, 1.0);
  EXPECT_NEAR(r[3].T_est.translation().z(), 3.0, 1e-12);        // block 0: scale 1/2
  EXPECT_NEAR(r[4].T_est.translation().z(), 3.0 + 6.0, 1e-12);  // block 1: 6 m over 2 units, scale 3
}

TEST(RescaleBlocks, ABlockAtAStandstillTakesTheScaleOfTheRun) {
  std::vector<MatchedPose> m(20);
  for (int i = 0; i < 20; ++i) {
    m[size_t(i)].frame = i;
    const double z = i < 10 ? 0 : i - 9;
    m[size_t(i)].T_gt = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, z));
    m[size_t(i)].T_est = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, z / 4));
  }
  const std::vector<MatchedPose> r = rescale_blocks(m, 10, 4.0);
  EXPECT_NEAR(r.back().T_est.translation().z(), 10.0,
              1e-12);  // also over the step that leaves the standstill
}

TEST(RescaleBlocks, RotationsAreUnchanged) {
  const std::vector<MatchedPose> matches = growing_scale(100);
  const std::vector<MatchedPose> r = rescale_blocks(matches, 20, 1.0);
  for (size_t i = 0; i < r.size(); ++i)
    EXPECT_LT(r[i].T_est.rotation().angularDistance(matches[i].T_est.rotation()), 1e-12);
}

}  // namespace
}  // namespace edgevo
