#pragma once
// The text files of a run, as strings: pure functions of the run, the same bytes every time.
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Which pose of a frame.
enum class PoseKind {
  kFinal,  ///< re-expressed from the final keyframe poses
  kLive    ///< as known when the frame came
};

/// TUM format, `t tx ty tz qx qy qz qw`: T_world_cam, one line for each frame that has such a pose, below
/// comment lines that tell axes and unit. qw >= 0.
std::string trajectory_tum(const Run& run, PoseKind kind);

/// One line of it.
std::string tum_line(Timestamp time, const SE3& T);

/// The same format with the final poses of the VEHICLE in the world of the map files (T_map_vehicle), where
/// it is known how the camera sits on it: x forward, y left, z up at the first pose.
std::string trajectory_vehicle_tum(const Run& run);

/// KITTI odometry format: row-major 3x4 T_world_cam, one line for each frame. The format has neither times
/// nor gaps nor comments: a frame without a pose repeats the one before it (the identity before the first),
/// as a robot that stands still.
std::string trajectory_kitti(const Run& run);

/// One row for each frame:
///   index,time,state,segment,keyframe,inlier_share,residual_px,edges,note,keyframe_rule,latency_ms,
///   ms_<stage>...
/// time in seconds; segment -1: none; keyframe 0 or 1; keyframe_rule: what called for one (with keyframe 0: while the mapping
/// was busy with another; "return": to an older keyframe), or empty; a stage that did not run in a frame is left empty, as
/// is the latency of a synchronous run. What depends on the clock comes last (`cut -d, -f1-10` gives what does
/// not), the stages in the order in which they first ran. A note holds no comma and no quote: both are
/// replaced, so that every reader can split at commas.
std::string frames_csv(const Run& run);
/// One row of it, with the times of these stages.
std::string frames_csv_row(const FrameRecord& frame, const std::vector<std::string>& stages);

/// How the metres were found, one row for each frame: index,time,factor,sigma,samples,live_factor,live_sigma.
/// Factors are metres per unit of the odometry, sigmas relative standard deviations; samples 0: not measured
/// here; live: what was known when the frame came, empty before anything was.
std::string scale_csv(const Run& run);

}  // namespace edgevo
