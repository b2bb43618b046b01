// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What mapping contributes to the result of a run: marginalised keyframes, those still in the window, lines
// and times. All in the unit of each segment's map. Safe in any thread.
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "edgevo/core/live_keyframes.h"
#include "edgevo/core/records.h"
#include "edgevo/odometry/mapper.h"

namespace edgevo {

/// Collects the results of mapping.
class MapRecords {
 public:
  /// Adds the CPU times that mapping took for a frame.
  void note_times(int frame_index, const StageTimes& times);
  /// Replaces the keyframes of the window; empty: there is none.
  void note_window(const std::deque<Keyframe>& keyframes, int segment);
  /// Adds keyframes that have left the window.
  void add_marginalised(const std::vector<Keyframe>& keyframes, int segment);
  /// Adds the lines of marginalised keyframes.
  void set_lines(std::vector<HostedLines> hosted);
  /// Moves the keyframes of the present segment after a correction of the camera.
  void revise(const std::vector<RevisedKeyframe>& keyframes);

  /// Number of corrections of the map so far.
  int revision() const;
  /// The marginalised keyframes so far, from index `first` on.
  MarginalisedKeyframes marginalised(size_t first) const;
  /// The keyframes of the window; nothing if that is still `version`.
  std::optional<ActiveKeyframes> active(int version) const;

  /// All results. Mapping has ended.
  struct Everything {
    /// Keyframes by id.
    std::map<int, KeyframeRecord> keyframes;
    /// CPU times by frame index.
    std::map<int, StageTimes> times;
    /// Number of corrections of the map.
    int revision = 0;
    /// Revisions by keyframe id, each with the new unit of length over the old one.
    std::map<int, std::vector<std::pair<int, double>>> length_ratio;

    /// Factor by which the unit of length near a keyframe has changed since a revision.
    double length_ratio_since(int keyframe_id, int revision) const;
  };
  /// Returns the results. Call once.
  Everything take();

 private:
  mutable std::mutex mutex_;
  Everything all_;
  ActiveKeyframes window_;
  std::vector<int> marginalised_;  // their ids in the order of marginalisation
};

}  // namespace edgevo
