#pragma once
// What the odometry is doing, as a state machine: pure, so that it can be tested as a table and read as a
// drawing (share/doc/architecture.md).
//
// A frame raises at most one event by being tracked, one by a look at how much of the map is in view, and one
// by being bootstrapped. transition() tells what follows; OdometryState adds the few numbers that outlive a
// frame.
#include "edgevo/core/tracking_state.h"

namespace edgevo {

enum class Phase {
  kBootstrapping,  ///< no map: two views are searched that make one
  kTracking,       ///< frames are tracked against the map
  kSeeking,        ///< tracked, with a second bootstrap under way: the map is out of view
  kLost,           ///< no pose: relocalisation in the old map is tried for some frames, and a bootstrap is under way
};

enum class Event {
  kTracked,     ///< a pose with the verdict TRACKING
  kDegraded,    ///< a pose with the verdict DEGRADED
  kUntracked,   ///< no pose
  kOutOfView,   ///< tracked, but next to nothing of known depth is in view, and that does not explain the images
  kInView,      ///< tracked, and the map is in view
  kMapMade,     ///< a bootstrap has made a map
  kMapRefused,  ///< two views were found, but make no map; the map before them is closed
};

/// The event of a frame that tracking gave this verdict, which is not kBootstrapping.
Event event_of(TrackingState verdict);

enum class Action {
  kNone,
  kLose,            ///< begin a bootstrap, tell the user
  kRelocalised,     ///< tell the user of the relocalisation in the old map
  kBeginBootstrap,  ///< beside a map that is still tracked
  kDropBootstrap,   ///< it is not needed any more
};

struct Transition {
  Phase next;
  Action action;
};

/// Every pair has an answer; an event that cannot come in a phase changes nothing.
Transition transition(Phase phase, Event event);

/// What outlives a frame besides the map itself.
class OdometryState {
 public:
  /// `max_relocalisation_tries`: frames with enough edges in which a relocalisation is tried after a loss.
  explicit OdometryState(int max_relocalisation_tries) : max_relocalisation_tries_(max_relocalisation_tries) {}

  Phase phase() const { return phase_; }
  bool has_map() const { return phase_ != Phase::kBootstrapping; }
  bool has_pose() const { return phase_ == Phase::kTracking || phase_ == Phase::kSeeking; }
  /// Of the map; the newest that there was where there is none. -1: none yet.
  int segment() const { return segment_; }

  /// Does a frame with so many edge pixels go to the tracker? After a loss each such frame is one of a
  /// limited number of tries.
  bool tracks(int edges);
  /// Does the frame go to the bootstrap, after it was tracked?
  bool bootstraps() const { return phase_ != Phase::kTracking; }

  /// The next state, and what is to be done about it.
  Action after(Event event, int frame_index);

  /// What a frame is called that has no pose: LOST at a loss and while there is nothing to follow after one,
  /// else BOOTSTRAPPING.
  TrackingState without_pose(int frame_index, int edges) const;
  /// The same for a frame that was not looked at.
  TrackingState passed_over() const;

 private:
  bool ever_tracked() const { return segment_ >= 0; }

  int max_relocalisation_tries_;
  Phase phase_ = Phase::kBootstrapping;
  int segment_ = -1;
  int relocalisation_tries_ = 0;  // since the loss
  int lost_at_ = -1;       // frame
};

}  // namespace edgevo
