// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A frame's image and pose as MRPT observations: the same in playback.rawlog and in what the plug-in records.
//
//   CObservationImage      the image, its calibration and the mount of the camera in metres
//   CObservationRobotPose  label EDGE_VO_LIVE: pose in `odom`, as it was known when the frame came:
//                          smooth, and it drifts
//   CObservationRobotPose  label EDGE_VO: pose in `map` with its covariance (playback_pose.h); it comes after
//                          EDGE_VO_LIVE, for programs that take the newest pose whatever its label
//   CObservationOdometry   label EDGE_VO_ODO: the same in the plane, for RawLogViewer's "map from odometry"
//   CObservationComment    at the time of a pose not to be trusted: "EDGE_VO: ...", p_right, state and
//                          reason (MRPT 2.5.8 does not store the label of a comment); and about the frames:
//                          "EDGE_VO: is_metric true; ...; unit: ..."
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

/// Pose of the vehicle in `map`. `T_world_cam` is the final pose of `frame`, or the newest that is known; the
/// frame provides time and covariance.
mrpt::obs::CObservationRobotPose::Ptr make_pose_observation(const Run& run, const FrameRecord& frame,
                                                            const SE3& T_world_cam);
/// Live pose of the vehicle in `odom`; null without one.
mrpt::obs::CObservationRobotPose::Ptr make_live_observation(const Run& run, const FrameRecord& frame);
/// The vehicle pose projected to the plane.
mrpt::obs::CObservationOdometry::Ptr make_odometry_observation(const Run& run, const FrameRecord& frame,
                                                               const SE3& T_world_cam);
/// Whether lengths are metres, and what is to be said of the frames ("map_changes 2").
mrpt::obs::CObservationComment::Ptr make_frames_observation(const Run& run, Timestamp time,
                                                            const std::string& frames);
/// What speaks against the pose of a doubtful frame (core/doubtful_frame.h); null if it is not doubtful.
mrpt::obs::CObservationComment::Ptr make_doubt_observation(const FrameRecord& frame);

}  // namespace edgevo
