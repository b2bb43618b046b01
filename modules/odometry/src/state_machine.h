// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// State of the odometry as a state machine: pure, so that it can be tested as a table and drawn as a diagram
// (share/doc/architecture.md).
//
// A frame raises at most one event by being tracked, one by a look at how much of the map is in view, and one
// by being bootstrapped. transition() defines the response; OdometryState adds the few numbers that outlive a
// frame.
#include <limits>
#include <optional>

#include "edgevo/core/tracking_state.h"
#include "edgevo/tracking/map_coverage.h"

namespace edgevo {

/// Phase of the odometry.
enum class Phase {
  /// No map: two views that make one are searched.
  kBootstrapping,
  /// Frames are tracked against the map.
  kTracking,
  /// Frames are tracked while a second bootstrap runs: the map is out of view.
  kSeeking,
  /// No pose: relocalisation in the old map is tried for some frames while a bootstrap runs.
  kLost,
};

/// Outcome of a step of a frame.
enum class Event {
  /// A pose with the status TRACKING.
  kTracked,
  /// A pose with the status DEGRADED.
  kDegraded,
  /// No pose.
  kUntracked,
  /// Tracked, but next to nothing of known depth is in view, and that does not explain the images.
  kOutOfView,
  /// Tracked, with the map in view.
  kInView,
  /// A bootstrap has made a map.
  kMapMade,
  /// Two views were found, but make no map; the map before them is closed.
  kMapRefused,
};

/// The event of a look at the map in view; nothing while that is uncertain.
std::optional<Event> event_of(MapInView seen);

/// The event of a tracked frame with this status, which is not kBootstrapping.
Event event_of(TrackingState status);

/// Response to a change of phase.
enum class Action {
  kNone,
  /// Begin a bootstrap, and report the loss.
  kLose,
  /// Report the relocalisation in the old map.
  kRelocalised,
  /// Begin a bootstrap while the map is still tracked.
  kBeginBootstrap,
  /// Drop the bootstrap, which is not needed any more.
  kDropBootstrap,
};

/// Entry of the transition table.
struct Transition {
  Phase next;
  Action action;
};

/// The transition table. Every pair has an entry; an event that cannot occur in a phase changes nothing.
Transition transition(Phase phase, Event event);

/// The state that outlives a frame, apart from the map itself.
class OdometryState {
 public:
  /// `max_relocalisation_tries`: frames with enough edges in which a relocalisation is tried after a loss.
  OdometryState(int max_relocalisation_tries, const StatusParams& params)
      : max_relocalisation_tries_(max_relocalisation_tries), params_(params) {}

  Phase phase() const { return phase_; }
  bool has_map() const { return phase_ != Phase::kBootstrapping; }
  bool has_pose() const { return phase_ == Phase::kTracking || phase_ == Phase::kSeeking; }
  /// Segment of the map; without a map that of the last one, or of the frames that were located; -1: none
  /// yet.
  int segment() const { return segment_; }

  /// Whether a frame with that many edge pixels is tracked. After a loss each such frame uses up one of a
  /// limited number of tries, or less where another sensor knows its heading to `heading_sigma`, radians:
  /// that share of what a search covers.
  bool tracks(int edges, double heading_sigma = std::numeric_limits<double>::infinity());
  /// Whether the frame goes to the bootstrap after it was tracked.
  bool bootstraps() const { return phase_ != Phase::kTracking; }

  /// Moves to the next state and returns what is to be done.
  Action after(Event event, int frame_index);
  /// Whether a frame may be located in a map that was kept: the run has made none yet.
  bool may_be_located() const { return phase_ == Phase::kBootstrapping && (segment_ < 0 || is_located_); }
  /// A frame has been located. Returns whether a segment without a map of its own begins with it.
  bool locate();

  /// Status of a frame without a pose: LOST at a loss and, after one, while there is nothing to follow, else
  /// BOOTSTRAPPING.
  TrackingState without_pose(int frame_index, int edges) const;
  /// Status of a frame that was skipped.
  TrackingState when_skipped() const;

 private:
  bool ever_tracked() const { return segment_ >= 0; }

  int max_relocalisation_tries_;
  StatusParams params_;
  Phase phase_ = Phase::kBootstrapping;
  int segment_ = -1;
  double relocalisation_tries_ = 0;  // since the loss
  int lost_at_ = -1;                 // frame
  bool is_located_ = false;          // the segment has no map of its own
};

}  // namespace edgevo
