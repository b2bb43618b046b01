// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Compares the unit of length of the map with that before a doubt: at the end of the doubt, and again later
// where nothing has linked the two. Matching the features of up to nine views takes 0.2 to 1 s, so that it is
// done next to the frames in realtime; what is found applies to the frame at which it is there.
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "edgevo/core/bounded_queue.h"
#include "edgevo/core/worker.h"
#include "edgevo/mapping/doubt_evaluation.h"
#include "edgevo/mapping/unresolved_scale.h"

namespace edgevo {

/// A comparison with one list of views.
struct ComparedScale {
  /// What was found.
  RelativeScale unit;
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
  /// The comparisons that were made.
  std::vector<ComparedScale> compared;
  /// The last of them, which counts; its `unit` is empty if there was nothing to compare.
  DoubtEvaluation found;
  /// Whether that one links the map to the view before.
  bool is_linked() const { return found.unit && found.unit->is_linked(); }
};

/// Begins the comparisons that are due and gives their answers; for the tracking thread.
class ScaleComparisons {
 public:
  /// From the map of a segment to the world: its scale.
  using ScaleOf = std::function<double(int segment)>;

  /// With `own_thread` comparisons are made next to the caller, else within begin().
  ScaleComparisons(const Pinhole& pinhole, bool own_thread);

  /// Adds a frame with a pose, seen in `view`, after IntegrityMonitor has. `before`:
  /// IntegrityMonitor::before(). Begins a comparison where a doubt ends, or where that with an earlier view
  /// is due.
  void begin(IntegrityMonitor::Integrity health, int frame_index, const TrustedReference& view,
             const std::vector<TrustedReference>& before, const ScaleOf& scale_of);
  /// The next answer; nothing if none is there. One that comes while the motion is in doubt again, or when
  /// another map or unit is in use than in its view, is dropped, and the unit compared again later.
  std::optional<ScaleAnswer> take(IntegrityMonitor::Integrity health, const TrustedReference& view);

 private:
  struct Candidates {
    std::vector<TrustedReference> before;
    bool is_open;
    double known_to;
  };
  void begin(ScaleAnswer answer, std::vector<Candidates> candidates, const ScaleOf& scale_of);
  bool is_idle() const;
  bool is_superseded(const ScaleAnswer& answer) const;
  void note(const ScaleAnswer& answer);
  void note_lost(const ScaleAnswer& answer);

  Pinhole pinhole_;
  UnresolvedScale open_;
  std::optional<std::pair<int, double>> rescaled_from_;  // segment and unit, by the last answer
  BoundedQueue<ScaleAnswer> answers_;
  Worker worker_;  // last member: it ends before the others
};

}  // namespace edgevo
