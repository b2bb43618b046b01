// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Compares the unit of length of the map with that before a doubt: at the end of the doubt, and again later
// where nothing has linked the two. Matching the features of up to nine views takes 0.2 to 1 s, so that it is
// done next to the frames in realtime; what is found applies to the frame at which it is there.
#include <functional>
#include <optional>
#include <vector>

#include "edgevo/core/bounded_queue.h"
#include "edgevo/core/worker.h"
#include "edgevo/mapping/doubt_evaluation.h"
#include "edgevo/mapping/open_unit.h"

namespace edgevo {

/// A comparison with one list of views.
struct ComparedUnit {
  /// What was found.
  UnitComparison unit;
  /// The views, newest first, and whether they are those of OpenUnit.
  std::vector<SureView> before;
  bool is_open = false;
};

/// What was found about the map that was seen in `now`.
struct UnitAnswer {
  /// Frame of the view, and the view.
  int frame_index = 0;
  SureView now;
  /// Whether a doubt ended there; else an earlier one was compared again.
  bool ends_doubt = false;
  /// The comparisons that were made.
  std::vector<ComparedUnit> compared;
  /// The last of them, which counts; its `unit` is empty if there was nothing to compare.
  DoubtEvaluation found;
  /// Whether that one links the map to the view before.
  bool is_linked() const { return found.unit && found.unit->is_linked(); }
};

/// Begins the comparisons that are due and gives their answers; for the tracking thread.
class UnitComparisons {
 public:
  /// From the map of a segment to the world: its scale.
  using ScaleOf = std::function<double(int segment)>;

  /// With `own_thread` comparisons are made next to the caller, else within begin().
  UnitComparisons(const Pinhole& pinhole, bool own_thread);

  /// Adds a frame with a pose, seen in `view`, after HealthWatch has. `before`: HealthWatch::before(). Begins
  /// a comparison where a doubt ends, or where that with an earlier view is due.
  void begin(HealthWatch::Health health, int frame_index, const SureView& view,
             const std::vector<SureView>& before, const ScaleOf& scale_of);
  /// The next answer; nothing if none is there. One that comes while the motion is in doubt again, or when
  /// another map or unit is in use than in its view, is dropped, and the unit compared again later.
  std::optional<UnitAnswer> take(HealthWatch::Health health, const SureView& view);

 private:
  struct Candidates {
    std::vector<SureView> before;
    bool is_open;
    double known_to;
  };
  void begin(UnitAnswer answer, std::vector<Candidates> candidates, const ScaleOf& scale_of);
  void note(const UnitAnswer& answer);
  void note_lost(const UnitAnswer& answer);

  Pinhole pinhole_;
  OpenUnit open_;
  BoundedQueue<UnitAnswer> answers_;
  Worker worker_;  // last member: it ends before the others
};

}  // namespace edgevo
