// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A frame's image and pose as MRPT observations: the same in playback.rawlog and in what the plug-in records.
//
//   CObservationImage      the image, its calibration and the mount of the camera in metres
//   CObservationRobotPose  label EDGE_VO: pose of the vehicle with its covariance (playback_pose.h)
//   CObservationOdometry   label EDGE_VO_ODO: the same in the plane, for RawLogViewer's "map from odometry"
//   CObservationComment    at the time of a pose not to be trusted: "EDGE_VO: ...", p_right, state and
//                          reason (MRPT 2.5.8 does not store the label of a comment)
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// An image observation without the image itself. `T_vehicle_cam`: mount as the source states it; that of a
/// camera that looks straight ahead if it states none.
mrpt::obs::CObservationImage::Ptr make_image_observation(Timestamp time, const std::string& label,
                                                         const Camera& camera,
                                                         const std::optional<SE3>& T_vehicle_cam);

/// Pose of the vehicle. `T_world_cam` is the final or the live pose of `frame`, which provides time and
/// covariance.
mrpt::obs::CObservationRobotPose::Ptr make_pose_observation(const Run& run, const FrameRecord& frame,
                                                            const SE3& T_world_cam);
/// The vehicle pose projected to the plane.
mrpt::obs::CObservationOdometry::Ptr make_odometry_observation(const Run& run, const FrameRecord& frame,
                                                               const SE3& T_world_cam);
/// What speaks against the pose of a doubtful frame (core/doubtful_frame.h); null if it is not doubtful.
mrpt::obs::CObservationComment::Ptr make_doubt_observation(const FrameRecord& frame);

}  // namespace edgevo
