#pragma once
// How a new segment is joined to the one before it.
//
// A bootstrap makes a map whose unit of length is arbitrary, and nothing has been seen in both maps. The
// camera is taken to have gone on at the mean velocity of its last frames up to the first view of the
// bootstrap; it keeps its last heading. The scale follows from the depths in view where the old map was still
// tracked, else from equal speed. All of this is a guess: FrameRecord::segment marks the join.
#include <optional>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/mapping/bootstrap.h"

namespace edgevo {

/// Where the map of a segment lies in the world, and how that was found.
struct SegmentJoin {
  enum class Method {
    /// There is no motion to go on with: the map is the world.
    kOrigin,
    /// Constant velocity up to the first view; the bootstrap is as fast.
    kVelocity,
    /// Constant velocity up to the first view; the scale was given, by the depths in view.
    kDepthRatio,
    /// Constant velocity, but the camera stood still before or in the bootstrap: the scale stays 1.
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

/// Poses that the velocity before a join is the mean of: one bad step matters less.
constexpr size_t kJoinPoses = 6;

/// `previous`: poses of the segment before, the oldest first; with fewer than two there is no velocity.
/// `scale`, world over map, where it is known better than by equal speed.
SegmentJoin join_segment(const std::vector<TimedPose>& previous, const BootstrapResult& bootstrap,
                         std::optional<double> scale);

}  // namespace edgevo
