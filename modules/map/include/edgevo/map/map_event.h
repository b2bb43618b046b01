// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What happens to the map, as a stream of plain values. Whoever changes the map appends an event to the
// MapLog; whoever keeps something derived from it (final poses, the recovery log, the live scale, a viewer)
// applies the events in their order and needs nothing else. The stream on disk is the recovery log.
//
// Coordinates: each segment has a map of its own, with an arbitrary unit of length and the axes of its first
// keyframe. All poses and depths in events are in that map; SegmentPlaced gives a first
// guess of its pose in the world, in the frame of live poses; EpochsPlaced what is known by now.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/core/records.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/sim3.h"
#include "edgevo/core/stage_times.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/edges/image_motion.h"
#include "edgevo/map/map_graph.h"

namespace edgevo {

/// A segment has begun: the pose of its map in the world, and how it was found.
struct SegmentPlaced {
  /// What the pose and the unit of length of a segment were taken from.
  enum class Method {
    /// No velocity is known: the map is the world.
    kOrigin,
    /// Constant velocity up to the first view; the scale follows from equal speed.
    kVelocity,
    /// Constant velocity up to the first view; the scale is the ratio of the depths in view.
    kDepthRatio,
    /// Constant velocity, but the camera stood still before or during the bootstrap: the scale stays 1.
    kStandstill,
    /// Features that the keyframes of both maps show.
    kLinked,
  };
  /// Number of the segment, from 0.
  int segment = 0;
  /// From the segment's map to the world.
  Sim3 T_world_map;
  /// How it was found.
  Method method = Method::kOrigin;
  /// Standard deviation of the logarithm of the scale; 0: the unit of the run.
  double scale_sigma = 0;
  /// Standard deviations of the rotation, radians, and of the place, in the unit of the world.
  double rotation_sigma = 0, position_sigma = 0;
};

/// A doubt about the motion has ended in the map in which it began: what lies after it may have another unit
/// of length than what lies before. Tracking goes on in the unit that it has.
struct EpochBegan {
  /// Number of the segment.
  int segment = 0;
  /// Last keyframe before the doubt that is sure, and first one after it. Those between belong to neither.
  int last_before = 0, first = 0;
  /// Standard deviation of the logarithm of the unit by which the map has carried it from the one to the
  /// other (AdjustmentEvidence::unit_variance).
  double unit_sigma = 0;
  /// Whether a frame between them is doubtful, or has no pose: else this deviation is all that is wrong.
  bool is_doubted = true;
};

/// A relation was found between keyframes, of whatever epochs.
struct ConstraintAdded {
  /// Number of the constraint in the run, from 0.
  int id = 0;
  /// The constraint; its nodes are keyframes. One of other nodes is kept, but does not count.
  Constraint constraint;
};

/// A relation has turned out to be none.
struct ConstraintWithdrawn {
  /// Number of the constraint.
  int id = 0;
};

/// Where an epoch lies, as far as is known.
struct EpochPlace {
  /// Number of its segment, and its own within that, from 0.
  int segment = 0, epoch = 0;
  /// Id of its first keyframe; -1: the first of the segment.
  int first_keyframe = -1;
  /// From the segment's map to the world, for the keyframes of the epoch.
  Sim3 T_world_map;
  /// Standard deviation of the logarithm of its scale; 0: that of the run.
  double scale_sigma = 0;
};

/// The epochs have been placed anew: of what was found. Follows EpochBegan, ConstraintAdded and
/// ConstraintWithdrawn.
struct EpochsPlaced {
  /// All epochs of the run, in time order.
  std::vector<EpochPlace> epochs;
  /// Number of the segment in use.
  int segment = 0;
  /// From the map of that segment to the frame in which live poses never jump, from now on: the newest
  /// pose stays, lengths are those of its epoch.
  Sim3 T_odom_map;
  /// From that frame to the world: a rigid motion.
  SE3 T_world_odom;
  /// Number of the newest constraint that was known when they were solved for; -1: none was.
  int newest_constraint = -1;
};

/// A frame has become a keyframe of the window.
struct KeyframeAdded {
  /// Id of the keyframe, ascending over the whole run.
  int id = 0;
  /// Index of its frame in the source.
  int frame_index = 0;
  /// Number of its segment.
  int segment = 0;
};

/// Motion between a keyframe that leaves the window and one that stays.
struct NeighbourPose {
  /// Id of the keyframe that stays.
  int id = 0;
  /// Pose of the leaving keyframe relative to it, as adjusted.
  SE3 T_leaving_neighbour;
  /// Covariance of xi in T_leaving_neighbour <- exp(xi) T_leaving_neighbour, tangent [v, w], from the matches
  /// that leave the window and what it knew of its poses before. Zero: unknown.
  Matrix6d covariance = Matrix6d::Zero();
};

/// Applies a change of the unit: new length over old length.
inline void scale_motion(double ratio, NeighbourPose* motion) {
  SE3& T = motion->T_leaving_neighbour;
  T = SE3(T.rotation(), ratio * T.translation());
  motion->covariance.topRows<3>() *= ratio;
  motion->covariance.leftCols<3>() *= ratio;
}

/// A keyframe has left the window; only a MapMoved changes it from now on.
struct KeyframeMarginalised {
  /// Id of the keyframe.
  int id = 0;
  /// The keyframe in the segment's map: T_world_cam is T_map_cam here. Without lines.
  std::shared_ptr<const KeyframeRecord> keyframe;
  /// The keyframes of the window that share points with it, ascending id.
  std::vector<NeighbourPose> neighbours;
  /// Its images, for those who look at them now; null if they are gone. Not part of the stream on disk.
  std::shared_ptr<const FramePyramid> pyramid = nullptr;
};

/// Why a map has moved.
enum class MoveReason {
  /// Self-calibration has corrected the camera.
  kCamera,
  /// Keyframes before the window were placed anew, e.g. because a place was seen again.
  kPast,
};

/// New values of one keyframe.
struct KeyframeMove {
  /// Id of the keyframe.
  int id = 0;
  /// Its pose after the move, relative to the newest keyframe of the map, in the unit of length there. That
  /// of the newest keyframe itself is the identity: nothing jumps for tracking or a servo loop.
  SE3 T_cam_newest;
  /// New length over old length near this keyframe.
  double scale_ratio = 1;
  /// New pixel and depth of a hosted point.
  struct Point {
    /// Pixel in the host image with the new correction.
    Eigen::Vector2d px;
    /// Inverse depth 1/z in the host frame.
    double idepth = 0;
  };
  /// All hosted points, in the order of the keyframe's points; empty: pixels stay, and depths change by
  /// `scale_ratio`.
  std::vector<Point> points;
  /// Motion of the image; corrected pixels depend on it.
  ImageMotion motion;
};

/// The correction of the camera that a move is due to.
struct LensChange {
  /// The correction applied before, and the new one.
  ImageCorrection before, now;
};

/// Keyframes of a segment have moved, all else stays.
struct MapMoved {
  /// Cause of the move.
  MoveReason reason = MoveReason::kPast;
  /// Segment whose map has moved.
  int segment = 0;
  /// Pose of the newest keyframe, which the moves refer to; Map::move() fills it.
  SE3 T_newest_map;
  /// The moved keyframes, ascending id.
  std::vector<KeyframeMove> keyframes;
  /// The correction, if the camera was corrected.
  std::optional<LensChange> lens;
  /// Prior of the marginalised keyframes on the window, required if keyframes of the window move; not part
  /// of the stream on disk.
  std::optional<BaPrior> prior;

  /// Pose of a moved keyframe in the map.
  SE3 T_cam_map(const KeyframeMove& move) const { return move.T_cam_newest * T_newest_map; }
  /// The move of a keyframe; null if it does not move.
  const KeyframeMove* find(int keyframe_id) const;
};

/// The window after a keyframe was processed: the state of the keyframes that have not been marginalised.
struct WindowAdjusted {
  /// Number of moves of the map before this state (MapMoved events of the run).
  int moves = 0;
  /// A keyframe of the window, in the segment's map as in KeyframeMarginalised.
  struct Active {
    /// Id of the keyframe.
    int id = 0;
    /// Its present state.
    KeyframeRecord keyframe;
    /// As KeyframeMarginalised::pyramid.
    std::shared_ptr<const FramePyramid> pyramid = nullptr;
  };
  /// The keyframes, oldest first; empty: the map was closed.
  std::shared_ptr<const std::vector<Active>> keyframes;
};

/// Lines of a keyframe are final.
struct LinesFinished {
  /// Id of the host keyframe.
  int keyframe_id = 0;
  /// Lines in the host's frame, in the unit of the segment's map.
  std::vector<EdgeLine> lines;
};

/// Self-calibration has a new result.
struct CameraEstimated {
  /// The result.
  CameraPosterior camera;
};

/// Mapping has processed a frame.
struct FrameMapped {
  /// Index of the frame in the source.
  int frame_index = 0;
  /// CPU times of mapping for this frame.
  StageTimes times;
  /// What the adjustment showed, if the frame became a keyframe.
  std::optional<AdjustmentEvidence> adjustment = std::nullopt;
};

/// A keyframe and the pose of a frame relative to it: the frame's final pose follows the keyframe.
struct FrameAnchor {
  /// Id of the keyframe.
  int keyframe_id = -1;
  /// Pose of the frame relative to the keyframe, in the unit of length of the map that it was measured in.
  SE3 T_cam_ref;
  /// Pose of the frame in that map.
  SE3 T_cam_map;
  /// Number of moves of that map when it was published (MapMoved events of the run).
  int moves = 0;
};

/// A frame has been processed, or its record has changed: a second event for the same frame replaces the
/// first (a bootstrap finds poses afterwards).
struct FrameAnchored {
  /// The record with its live pose, which is in the world.
  FrameRecord frame;
  /// Its anchor; nothing if it has no pose.
  std::optional<FrameAnchor> anchor;
};

/// Any event.
using MapEvent = std::variant<SegmentPlaced, EpochBegan, ConstraintAdded, ConstraintWithdrawn, EpochsPlaced,
                              KeyframeAdded, KeyframeMarginalised, MapMoved, WindowAdjusted, LinesFinished,
                              CameraEstimated, FrameMapped, FrameAnchored>;

}  // namespace edgevo
