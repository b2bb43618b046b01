// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The text files of a run, as strings. Pure functions of the run: the same run gives the same bytes.
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Kinds of poses that a frame has.
enum class PoseKind {
  /// Pose re-expressed from the final keyframe poses.
  kFinal,
  /// Pose as known when the frame was processed.
  kLive
};

/// T_world_cam in TUM format, `t tx ty tz qx qy qz qw`: one line for each frame that has such a pose, below
/// comment lines with axes and unit. qw >= 0.
std::string trajectory_tum(const Run& run, PoseKind kind);

/// One line of a trajectory in TUM format.
std::string tum_line(Timestamp time, const SE3& T);

/// Final poses of the VEHICLE in TUM format, in the world of the map files (T_map_vehicle): x forward, y
/// left, z up at the first pose. Needs the mount of the camera (Run::T_vehicle_cam).
std::string trajectory_vehicle_tum(const Run& run);

/// T_world_cam in KITTI odometry format: row-major 3x4 matrices, one line for each frame. The format has no
/// times, gaps or comments: a frame without a pose repeats the one before it (the identity before the first),
/// as if the robot stood still.
std::string trajectory_kitti(const Run& run);

/// frames.csv, one row for each frame:
///   index,time,state,segment,keyframe,inlier_share,residual_px,edges,note,keyframe_rule,latency_ms,
///   visible_points,matched_points,pose_sigma,step_sigmas,known_points,lacking_share,view_share,
///   saturated_share,edge_blur,median_depth,moved_by_map,adjusted_move,adjusted_cost,adjusted_matches,
///   adjusted_points,adjusted_here,adjusted_unit_sigma,p_right,ms_<stage>...
/// time is in seconds; segment -1: none; keyframe 0 or 1; keyframe_rule: the reason for a keyframe, or empty
/// (with keyframe 0: mapping was busy with another; "return": tracking went back to an older keyframe).
/// visible_points to adjusted_unit_sigma are the evidence (core/frame_evidence.h), pose_sigma the largest of
/// pose_sigmas; unknown values are empty. So are stages that did not run in a frame, and the latency of a
/// synchronous run. The latency and the stages depend on the clock (`cut -d, -f1-10,12-52` drops them);
/// stages come in the order in which they first ran. Commas and quotes in a note are replaced, so that every
/// reader can split at commas.
std::string frames_csv(const Run& run);
/// One row of frames.csv, with the times of `stages`.
std::string frames_csv_row(const FrameRecord& frame, const std::vector<std::string>& stages);

/// covariances.csv, one row for each frame with a known covariance: index of the frame, reference (index of
/// the frame of the keyframe that it was tracked against), and the upper triangle of FrameRecord::covariance,
/// row by row: c00, c01, ..., c55.
std::string covariances_csv(const Run& run);

/// graph.csv, one row for each epoch and each constraint:
/// what,segment,epoch,first_frame,last_frame,scale,sigma,holds. `what` is "epoch" or the kind of the
/// constraint, whose frames are those of its keyframes; lengths of an epoch are `scale` times as long in the
/// run, before
/// --scale; those near the first keyframe of a constraint `scale` times those near the second.
std::string graph_csv(const Run& run);

/// scale.csv, the metric scale, one row for each frame:
/// index,time,factor,sigma,samples,live_factor,live_sigma. Factors are metres per unit of the odometry,
/// sigmas relative standard deviations; samples 0: not measured in this frame. The live columns hold what was
/// known when the frame was processed; empty: nothing yet.
std::string scale_csv(const Run& run);

}  // namespace edgevo
