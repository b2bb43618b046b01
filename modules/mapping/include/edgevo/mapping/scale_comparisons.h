// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Compares the unit of length of the map with that before a doubt: at the end of the doubt, and again later
// where nothing has linked the two. Matching the features of up to nine views takes 0.2 to 1 s, so that it is
// done next to the frames in realtime; what is found applies to the frame at which it is there.
#include <optional>
#include <vector>

#include "edgevo/core/bounded_queue.h"
#include "edgevo/core/worker.h"
#include "edgevo/mapping/doubt_evaluation.h"
#include "edgevo/mapping/unresolved_scale.h"

namespace edgevo {

/// A comparison with one list of views.
struct ComparedScale {
  /// What was found.
  DoubtEvaluation found;
  /// The views, newest first.
  std::vector<TrustedReference> before;
  /// Whether they are those of UnresolvedScale.
  bool is_open = false;
};

/// What was found about the map that was seen in `now`.
struct ScaleAnswer {
  /// Frame of the view.
  int frame_index = 0;
  /// The view.
  TrustedReference now;
  /// Whether a doubt ended there; else an earlier one was compared again.
  bool ends_doubt = false;
  /// With the end of a doubt, the newest view before it; nothing before the first map.
  std::optional<TrustedReference> last_before;
  /// The comparisons that were made; the last of them counts.
  std::vector<ComparedScale> compared;
  /// Whether the keyframes of the doubt count from now on: not if the motion is in doubt again.
  bool confirms_map = false;

  /// What counts.
  const DoubtEvaluation& found() const { return compared.back().found; }
  /// Whether a doubt ended in the map in which it began, and the reference is a later keyframe since.
  bool begins_epoch() const {
    return ends_doubt && last_before && last_before->segment == now.segment &&
           last_before->reference->keyframe_id < now.reference->keyframe_id;
  }
};

/// Begins the comparisons that are due and gives their answers; for the tracking thread.
class ScaleComparisons {
 public:
  /// With `own_thread` comparisons are made next to the caller, else within begin().
  ScaleComparisons(const Pinhole& pinhole, bool own_thread);

  /// Adds a frame with a pose, seen in `view`, after IntegrityMonitor has. `before`:
  /// IntegrityMonitor::before(). Begins a comparison where a doubt ends, or where that with an earlier view
  /// is due.
  void begin(IntegrityMonitor::Integrity health, int frame_index, const TrustedReference& view,
             const std::vector<TrustedReference>& before, const ScaleOfView& scale_of);
  /// The next answer; nothing if none is there. One that comes while the motion is in doubt again, or when
  /// another map is in use than in its view, says what it says of the past, and confirms no map.
  std::optional<ScaleAnswer> take(IntegrityMonitor::Integrity health, const TrustedReference& view);

 private:
  struct Candidates {
    std::vector<TrustedReference> before;
    bool is_open;
  };
  void begin(ScaleAnswer answer, std::vector<Candidates> candidates, const ScaleOfView& scale_of);
  bool is_idle() const;

  Pinhole pinhole_;
  UnresolvedScale open_;
  BoundedQueue<ScaleAnswer> answers_;
  Worker worker_;  // last member: it ends before the others
};

}  // namespace edgevo
