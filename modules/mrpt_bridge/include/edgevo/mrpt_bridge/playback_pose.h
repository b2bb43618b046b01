// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Camera poses and their covariance as MRPT's vehicle poses.
//
// With C = T_map_world(run), the mount of the camera (or that of a camera that looks straight ahead), and rel
// = T_world_cam,
//     V = C (+) rel (+) inverse(C)
// is the pose of the vehicle (x forward, y left, z up) in the world of the map files, identity at the first
// frame.
//
// Covariance: FrameRecord::covariance belongs to T_cur_ref <- exp(xi) T_cur_ref, hence to rel <- rel
// exp(-xi), hence to
//     V <- V exp(eta),  eta = -Ad(C) xi,  Sigma_eta = Ad(C) Sigma_xi Ad(C)^T
// MRPT's CPose3DPDFGaussian wants the covariance of (x y z yaw pitch roll) with R = Rz(yaw) Ry(pitch)
// Rx(roll):
//     d(x y z)            = R v
//     d(yaw, pitch, roll) = E(pitch, roll) w,   E = [ 0  sin r/cos p   cos r/cos p ;
//                                                     0  cos r        -sin r       ;
//                                                     1  sin r tan p   cos r tan p ]
// for eta = [v, w]. E is singular at pitch = +-90 degrees (the vehicle stands on end); cos p is kept at 1e-3
// or more there, so that the covariance becomes large and stays finite. It is the covariance relative to the
// reference keyframe: drift is not in it. Zero means unknown.
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "edgevo/core/records.h"

namespace edgevo {

/// Pose of the vehicle in the world of the map files.
SE3 T_map_vehicle(const Run& run, const SE3& T_world_cam);

/// Jacobian d(x y z yaw pitch roll) / d eta of T exp(eta) at eta = 0, tangent [v, w].
Matrix6d d_mrpt_pose_d_right_tangent(const SE3& T);

/// Pose of the vehicle with its covariance. `covariance` is FrameRecord::covariance.
mrpt::poses::CPose3DPDFGaussian vehicle_pose_pdf(const Run& run, const SE3& T_world_cam,
                                                 const Matrix6d& covariance);

}  // namespace edgevo
