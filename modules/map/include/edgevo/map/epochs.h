// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The units of length of a run, and the places of its parts.
//
// An epoch is an interval of a segment within which the unit of length is one. A new map begins one, and so
// does the end of a doubt: within the doubt the unit may have changed. What relates two epochs is never
// applied and forgotten but kept, as constraints with covariances: that the camera went on (continuity),
// equal speed or depths at a join, features that both show, whatever comes later. All epochs are solved for
// at once (map_graph.h), each time that something is found.
//
// Continuity has two modes: a doubt was groundless and the unit is what it was, to a per cent; or it was not,
// and nothing is known. Features decide, by what they are worth. A turn in which no frame is doubtful, but in
// which the map has carried the unit badly, has one mode: to what it was carried.
//
// Between two epochs lies the doubt. Its keyframes belong to neither: their unit goes over from one to the
// other in proportion to their doubt (1 - p_right, and the unit's growing variance), the mean of a random
// walk whose variance is that doubt and whose both ends are known.
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "edgevo/map/map_event.h"

namespace edgevo {

/// A keyframe in its segment's map.
struct KeyframeInMap {
  /// Id of the keyframe.
  int id = 0;
  /// Number of its segment.
  int segment = 0;
  /// Index of its frame in the source.
  int frame_index = 0;
  /// Its pose there.
  SE3 T_map_cam;
};

/// What the placing of epochs reads of a run.
struct RunSoFar {
  /// A keyframe by its id; nothing if it is not known (any more).
  std::function<std::optional<KeyframeInMap>(int id)> keyframe;
  /// The known keyframes of a segment with ids from `first` to `last`, both included, in their order.
  std::function<std::vector<KeyframeInMap>(int segment, int first, int last)> keyframes;
  /// Covariance of the pose of keyframe `id` relative to a later one, as NeighbourPose; nothing if it is not
  /// known.
  std::function<std::optional<Matrix6d>(int id, int later_id)> covariance_between;
  /// The doubt in the motion from one frame to a later one: the sum of 1 - p_right.
  std::function<double(int frame, int later_frame)> doubt;
};

/// Where all parts of a run lie.
struct PlacedEpochs {
  /// The epochs, in time order.
  std::vector<EpochPlace> epochs;
  /// For the keyframes that do not move with an epoch, by id: from their segment's map to the world. Those
  /// between two epochs, and all where a place was seen again.
  std::map<int, Sim3> own;
  /// The constraints that the others contradict in their unit or place, by their numbers in the run.
  std::vector<int> unused;
  /// Number of the newest constraint that was known; -1: none was.
  int newest_constraint = -1;
  /// Whether a constraint is one of them.
  bool is_unused(int id) const { return std::find(unused.begin(), unused.end(), id) != unused.end(); }

  /// The epoch of a keyframe, or of one between two epochs the earlier one; null if its segment is not known.
  const EpochPlace* find(int segment, int keyframe_id) const;
  /// From the map of a keyframe to the world. Its segment must have begun.
  const Sim3& T_world_map(int segment, int keyframe_id) const;
};

/// Collects what relates the epochs of a run. A value; for one thread.
class Epochs {
 public:
  /// A segment has begun. `T_world_previous`: from the map of the segment before to the frame that
  /// `placed.T_world_map` leads to.
  void begin_segment(const SegmentPlaced& placed, const Sim3& T_world_previous);
  /// A doubt has ended. Events that do not fit what is known, of a damaged log, are ignored.
  void begin_epoch(const EpochBegan& began);
  /// A constraint was found.
  void add(const ConstraintAdded& added) { constraints_[added.id] = added.constraint; }
  /// A constraint is none.
  void withdraw(int id) { constraints_.erase(id); }

  /// Number of epochs.
  size_t count() const { return epochs_.size(); }
  /// The constraints, by their numbers in the run.
  const std::map<int, Constraint>& constraints() const { return constraints_; }
  /// Whether a keyframe is one that a constraint or an epoch refers to.
  bool refers_to(int keyframe_id) const;
  /// Where all keyframes lie: as solve(), and within the epochs where a constraint relates two keyframes of
  /// one. `keyframes`: all that are known, ascending id. Cost: that of solve(), and some 0.1 ms a keyframe if
  /// there is such a constraint.
  PlacedEpochs solve_keyframes(const RunSoFar& run, const std::vector<KeyframeInMap>& keyframes) const;
  /// Where all parts lie. Cost: a solution of the graph of units and one of that of places, half a
  /// millisecond an epoch.
  PlacedEpochs solve(const RunSoFar& run) const;

 private:
  struct Epoch {
    EpochPlace place;         // as it was announced, or that of the epoch before it
    int last_before = -1;     // keyframe before the doubt that it begins after; -1: it begins a segment
    double unit_sigma = 0;    // EpochBegan::unit_sigma
    bool is_doubted = false;  // EpochBegan::is_doubted
    // Of a segment after the first: from its map to that of the segment before.
    std::optional<Sim3> T_previous;
    // Of T_previous: radians, unit of the segment before, logarithm of the scale.
    double rotation_sigma = 0, position_sigma = 0, join_sigma = 0;
  };
  class Solver;

  std::vector<Epoch> epochs_;  // in time order
  std::map<int, Constraint> constraints_;
};

}  // namespace edgevo
