#pragma once
// What mapping leaves behind of a run: keyframes as they left the window, those still in it, lines and times.
// All in the unit of each segment's map. Any thread.
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/core/live_keyframes.h"
#include "edgevo/odometry/mapper.h"

namespace edgevo {

class MapRecords {
 public:
  /// The times that mapping took for a frame.
  void note_times(int frame_index, const StageTimes& times);
  /// The window as it stands; empty: there is none.
  void note_window(const std::deque<Keyframe>& keyframes, int segment);
  /// Keyframes that have left the window.
  void retire(const std::vector<Keyframe>& keyframes, int segment);
  /// The lines of keyframes that have retired.
  void set_lines(std::vector<HostedLines> hosted);
  /// The camera was corrected: keyframes of the present segment have moved.
  void revise(const std::vector<RevisedKeyframe>& keyframes);

  /// Corrections of the map so far.
  int revision() const;
  /// What retire() was given so far, but for the first `skip`.
  SettledKeyframes settled(size_t skip) const;
  /// What note_window() was given last; none if that was `version`.
  std::optional<UnsettledKeyframes> unsettled(int version) const;

  /// All that was noted. The mapping is over.
  struct Everything {
    std::map<int, KeyframeRecord> keyframes;  ///< by id
    std::map<int, StageTimes> times;          ///< by frame index
    int revision = 0;                         ///< corrections of the map
    /// By keyframe id: revision, and the new unit of length over the old one.
    std::map<int, std::vector<std::pair<int, double>>> length_ratio;

    /// How much the unit of length near a keyframe has changed since a revision.
    double length_ratio_since(int keyframe_id, int revision) const;
  };
  Everything take();

 private:
  mutable std::mutex mutex_;
  Everything all_;
  UnsettledKeyframes window_;
  std::vector<int> retired_;  // their ids in the order of retiring
};

}  // namespace edgevo
