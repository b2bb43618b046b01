// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a new segment is joined to the one before it.
//
// A bootstrap makes a map whose unit of length is arbitrary, and nothing has been seen in both maps. The
// camera is assumed to continue at the mean velocity of its last frames up to the first view of the
// bootstrap, with its last orientation or that which a gyro has followed, unless features link the two maps
// (features/view_link.h). The scale follows from the depths in view if the old map was still tracked, else
// from equal speed: that of the last poses that were sure, since a map that is about to be lost has often
// lost its unit before. All of this is a guess: FrameRecord::segment marks the join.
#include <optional>
#include <vector>

#include "edgevo/alignment/reference.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/map/located_pose.h"
#include "edgevo/map/map_event.h"
#include "edgevo/map/run_builder.h"

namespace edgevo {

/// Number of poses that the velocity before a join is averaged over: one bad step matters less.
constexpr size_t kJoinPoses = 6;

/// A rotation that another sensor measured.
struct MeasuredTurn {
  /// From the earlier camera to the later one.
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  /// Standard deviation about each axis, radians.
  double sigma = 0;
};

/// The way of the camera while a map was made.
struct MapBeginning {
  /// Times of the first and the last view that made it.
  Timestamp first, last;
  /// Motion from the first view to the last, in the unit of the map.
  SE3 T_last_first;
  /// Rotation from the newest pose of the segment before to the first view; nothing: not measured.
  std::optional<MeasuredTurn> turn = std::nullopt;
};

/// What both a keyframe a of one map and a keyframe b of another show.
struct SegmentLink {
  /// Motion from a to b, length in the unit of the map of a.
  SE3 T_b_a;
  /// A length in the map of a over the same length in that of b, and the standard deviation of its logarithm.
  double scale = 1, sigma = 0;
};

/// Joins segment `segment` to the one before. `previous`: poses of the segment before, oldest first; with
/// fewer than two there is no velocity. `sure`: the last poses that were sure, in that order, or fewer than
/// two: their speed counts, and the direction of `previous`. `scale` is world over map, where it is known
/// better than from equal speed.
SegmentPlaced join_segment(int segment, const std::vector<TimedPose>& previous,
                           const std::vector<TimedPose>& sure, const MapBeginning& beginning,
                           std::optional<double> scale);

/// What the link says of the two keyframes, with the uncertainty of a motion of two views.
Constraint constraint_of(const SegmentLink& link, const Reference& a, const Reference& b);

/// Joins segment `segment`, whose newest keyframe is `after`, to the map that `before` is of, by what both
/// keyframes see. `T_world_before`: from the map of `before` to the world.
SegmentPlaced link_segment(int segment, const Reference& before, const Sim3& T_world_before,
                           const Reference& after, const SegmentLink& link);

/// Joins segment `segment` to a map that was kept, in which a frame was located; that frame is at `T_cam_map`
/// in the new map, whose median depth is `median_depth`.
SegmentPlaced locate_segment(int segment, const LocatedPose& located, const SE3& T_cam_map,
                             double median_depth);
/// What a segment that is located says of its keyframe at `T_keyframe_map`: where it lies in the kept map,
/// whose frame is the world, as the camera went on from the frame that was located.
Constraint place_of(int keyframe_id, const SE3& T_keyframe_map, const SegmentPlaced& located);

}  // namespace edgevo
