// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/playback_pose.h"

#include <cmath>

#include "edgevo/mrpt_bridge/conversions.h"

namespace edgevo {
namespace {

// Within 0.06 degrees of the vertical yaw and roll are one: keeps their covariance finite.
constexpr double kMinCosPitch = 1e-3;

// d(yaw pitch roll) / d w for R exp(w).
Eigen::Matrix3d d_angles_d_rotation(double pitch, double roll) {
  const double cos_pitch = std::max(std::cos(pitch), kMinCosPitch);
  const double tan_pitch = std::sin(pitch) / cos_pitch;
  const double s = std::sin(roll), c = std::cos(roll);
  Eigen::Matrix3d E;
  E << 0, s / cos_pitch, c / cos_pitch,  //
      0, c, -s,                          //
      1, s * tan_pitch, c * tan_pitch;
  return E;
}

}  // namespace

SE3 T_map_vehicle(const Run& run, const SE3& T_world_cam) {
  const SE3 T_vehicle_cam = T_map_world(run);
  return T_vehicle_cam * T_world_cam * T_vehicle_cam.inverse();
}

Matrix6d d_mrpt_pose_d_right_tangent(const SE3& T) {
  const mrpt::poses::CPose3D pose = to_mrpt(T);
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = T.R();
  J.bottomRightCorner<3, 3>() = d_angles_d_rotation(pose.pitch(), pose.roll());
  return J;
}

mrpt::poses::CPose3DPDFGaussian vehicle_pose_pdf(const Run& run, const SE3& T_world_cam,
                                                 const Matrix6d& covariance) {
  const SE3 V = T_map_vehicle(run, T_world_cam);
  const Matrix6d J = d_mrpt_pose_d_right_tangent(V) * T_map_world(run).adjoint();
  const Matrix6d sigma = J * covariance * J.transpose();
  mrpt::poses::CPose3DPDFGaussian pdf(to_mrpt(V));
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col) pdf.cov(row, col) = 0.5 * (sigma(row, col) + sigma(col, row));
  return pdf;
}

}  // namespace edgevo
