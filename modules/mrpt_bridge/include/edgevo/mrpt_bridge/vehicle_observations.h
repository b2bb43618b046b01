#pragma once
// A frame's image and pose as MRPT observations: the same in playback.rawlog and in what the plug-in records.
//
//   CObservationImage      the image, its calibration and the mount of the camera in metres
//   CObservationRobotPose  label EDGE_VO: pose of the vehicle with its covariance (playback_pose.h)
//   CObservationOdometry   label EDGE_VO_ODO: the same in the plane, for RawLogViewer's "map from odometry"
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// Everything but the image itself. `T_vehicle_cam`: as the source says; a camera that looks straight ahead where
/// it says nothing.
mrpt::obs::CObservationImage::Ptr make_image_observation(Timestamp time, const std::string& label,
                                                         const Camera& camera,
                                                         const std::optional<SE3>& T_vehicle_cam);

/// `T_world_cam`: the final or the live pose of `frame`, whose time and covariance go with it.
mrpt::obs::CObservationRobotPose::Ptr make_pose_observation(const Run& run, const FrameRecord& frame,
                                                            const SE3& T_world_cam);
/// The same pose in the plane.
mrpt::obs::CObservationOdometry::Ptr make_odometry_observation(const Run& run, const FrameRecord& frame,
                                                               const SE3& T_world_cam);

}  // namespace edgevo
