// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a new segment is joined to the one before it.
//
// A bootstrap makes a map whose unit of length is arbitrary, and nothing has been seen in both maps. The
// camera is assumed to continue at the mean velocity of its last frames up to the first view of the
// bootstrap, with its last orientation. The scale follows from the depths in view if the old map was still
// tracked, else from equal speed. All of this is a guess: FrameRecord::segment marks the join.
#include <optional>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/mapping/bootstrap.h"

namespace edgevo {

/// The pose of a segment's map in the world, and how it was found.
struct SegmentJoin {
  enum class Method {
    /// No velocity is known: the map is the world.
    kOrigin,
    /// Constant velocity up to the first view; the scale follows from equal speed.
    kVelocity,
    /// Constant velocity up to the first view; the scale was given, from the depths in view.
    kDepthRatio,
    /// Constant velocity, but the camera stood still before or during the bootstrap: the scale stays 1.
    kStandstill,
  };
  Method method = Method::kOrigin;
  Sim3 T_world_map;
};

/// The live pose of a frame.
struct TimedPose {
  Timestamp time;
  SE3 T_world_cam;
};

/// Number of poses that the velocity before a join is averaged over: one bad step matters less.
constexpr size_t kJoinPoses = 6;

/// Joins a segment to the one before. `previous`: poses of the segment before, oldest first; with fewer than
/// two there is no velocity. `scale` is world over map, where it is known better than from equal speed.
SegmentJoin join_segment(const std::vector<TimedPose>& previous, const BootstrapResult& bootstrap,
                         std::optional<double> scale);

}  // namespace edgevo
