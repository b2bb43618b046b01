// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/playback_pose.h"

#include <gmock/gmock.h>

#include <cmath>

#include "edgevo/core/random.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

Vector6d mrpt_coordinates(const SE3& T) {
  const mrpt::poses::CPose3D p = to_mrpt(T);
  Vector6d v;
  v << p.x(), p.y(), p.z(), p.yaw(), p.pitch(), p.roll();
  return v;
}

Vector6d random_tangent(Random* random, double translation, double rotation) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = random->uniform(-1, 1) * (i < 3 ? translation : rotation);
  return xi;
}

TEST(VehiclePose, JacobianAgreesWithFiniteDifferences) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const SE3 T = SE3::exp(random_tangent(&random, 3, 0.8));
    const Matrix6d J = d_mrpt_pose_d_right_tangent(T);
    const auto coordinates = [&](const Vector6d& d) { return mrpt_coordinates(T * SE3::exp(d)); };
    EXPECT_THAT(J, test::JacobianNear(test::numerical_jacobian<6>(coordinates), 1e-8)) << "trial " << trial;
  }
}

TEST(VehiclePose, FirstFrameIsTheOriginAndForwardIsX) {
  const edgevo::Run run;
  EXPECT_LT(T_map_vehicle(run, SE3()).log().norm(), 1e-15);
  const SE3 ahead(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.5, -0.25, 2));  // right, up, forward
  EXPECT_TRUE(T_map_vehicle(run, ahead).translation().isApprox(Eigen::Vector3d(2, -0.5, 0.25)));
}

TEST(VehiclePose, TurningRightInTheImageIsNegativeYaw) {
  const SE3 right(Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())),
                  Eigen::Vector3d::Zero());
  const auto pdf = vehicle_pose_pdf(edgevo::Run(), right, Matrix6d::Zero());
  EXPECT_NEAR(pdf.mean.yaw(), -0.3, 1e-12);
  EXPECT_NEAR(pdf.mean.pitch(), 0, 1e-12);
  EXPECT_NEAR(pdf.mean.roll(), 0, 1e-12);
}

// The mount of a car camera: 1.6 up, pitched down. A vehicle in pure rotation moves its camera on a circle.
TEST(VehiclePose, LeverArmOfAMetricMountIsCompensated) {
  edgevo::Run run;
  run.scale_source = "odometry";
  const SE3 pitch(Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY())),
                  Eigen::Vector3d(1.5, 0.1, 1.6));
  run.T_vehicle_cam = pitch * T_zup_world();
  const SE3 V(Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ())), Eigen::Vector3d::Zero());
  const SE3 T_world_cam = run.T_vehicle_cam->inverse() * V * *run.T_vehicle_cam;
  EXPECT_LT((T_map_vehicle(run, T_world_cam).inverse() * V).log().norm(), 1e-12);
}

// Sample the tracking error by its definition, transform each sample to MRPT's coordinates, compare the
// spread.
TEST(VehiclePose, CovarianceAgreesWithMonteCarlo) {
  edgevo::Run run;
  run.scale_source = "odometry";
  run.T_vehicle_cam = SE3(T_zup_world().rotation(), Eigen::Vector3d(1.0, 0.2, 1.5));
  Random random(7);
  const SE3 T_world_ref = SE3::exp(random_tangent(&random, 2, 0.3));
  const SE3 T_cur_ref = SE3::exp(random_tangent(&random, 1, 0.3));
  Matrix6d root = Matrix6d::Zero();  // a full covariance, rotation and translation correlated
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col <= row; ++col) root(row, col) = 0.01 * random.uniform(-1, 1);
  const Matrix6d covariance = root * root.transpose();
  const auto pdf = vehicle_pose_pdf(run, T_world_ref * T_cur_ref.inverse(), covariance);

  constexpr int kDraws = 40000;
  const Vector6d mean = mrpt_coordinates(from_mrpt(pdf.mean));
  Matrix6d spread = Matrix6d::Zero();
  for (int n = 0; n < kDraws; ++n) {
    Vector6d unit;
    for (int i = 0; i < 6; ++i) unit[i] = random.normal();
    const SE3 T_cur_ref_drawn = SE3::exp(root * unit) * T_cur_ref;
    const Vector6d d = mrpt_coordinates(T_map_vehicle(run, T_world_ref * T_cur_ref_drawn.inverse())) - mean;
    spread += d * d.transpose() / kDraws;
  }
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col) {
      // Four standard errors of a covariance estimated from kDraws.
      const double scale = std::sqrt(spread(row, row) * spread(col, col));
      EXPECT_NEAR(pdf.cov(row, col), spread(row, col), 4 * scale * std::sqrt(2.0 / kDraws))
          << row << "," << col;
    }
}

TEST(VehiclePose, CovarianceStaysFiniteAtVerticalPitch) {
  const SE3 down(Eigen::Quaterniond(Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX())),
                 Eigen::Vector3d::Zero());
  const auto pdf = vehicle_pose_pdf(edgevo::Run(), down, 1e-4 * Matrix6d::Identity());
  EXPECT_NEAR(std::abs(pdf.mean.pitch()), M_PI / 2, 1e-6);
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(std::isfinite(pdf.cov(i, i))) << i;
}

}  // namespace
}  // namespace edgevo
