// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a run knows of its path: a value, which another thread may solve while the run goes on.
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "edgevo/map/epochs.h"
#include "edgevo/map/map_event.h"

namespace edgevo {

/// The keyframes of a run and what relates them.
struct RunPath {
  /// The epochs, and the constraints.
  Epochs epochs;
  /// The marginalised keyframes, by id.
  std::map<int, KeyframeInMap> marginalised;
  /// The motion of each to the next keyframe that shares points, by id.
  std::map<int, NeighbourPose> neighbours;
  /// The window as announced last.
  WindowAdjusted window;

  /// A keyframe that is marginalised or in the window, by its id; nothing if it is not known (any more).
  std::optional<KeyframeInMap> find(int id) const;
  /// Those of a segment with ids from `first` to `last`, both included, in their order.
  std::vector<KeyframeInMap> find(int segment, int first, int last) const;
  /// The keyframes of the window, oldest first.
  const std::vector<WindowAdjusted::Active>& active() const;
  /// As NeighbourPose::covariance, of two keyframes; nothing if it is not known.
  std::optional<Matrix6d> covariance_between(int id, int later_id) const;
  /// The marginalised keyframes, ascending id; with those of the window once one of these is found in a kept
  /// map, whose frame and unit the newest pose then has. A loop of the run itself can wait: it moves the past
  /// alone.
  std::vector<KeyframeInMap> keyframes() const;
  /// All of this for the solution. Refers to this object. `doubt` as in RunSoFar.
  RunSoFar run_so_far(std::function<double(int frame, int later_frame)> doubt) const;
  /// Whether a keyframe of the window was found in a kept map.
  bool is_window_in_kept_map() const;
};

}  // namespace edgevo
