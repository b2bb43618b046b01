// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// When the motion is in doubt, when it is sure again, and what was seen before the doubt.
//
// p_right of a frame speaks of the motion over the ten frames up to it. So a doubtful frame throws doubt on
// these ten, and health has returned once ten frames in a row are sure: their p_right speaks of nothing that
// was doubted. Between the two the map may have changed its unit.
#include <memory>
#include <optional>
#include <vector>

#include "edgevo/alignment/reference.h"
#include "edgevo/core/motion_tolerance.h"

namespace edgevo {

/// Frames that p_right speaks of.
inline constexpr int kDoubtReach = kMotionTolerance.frames;

/// What a frame was tracked against.
struct TrustedReference {
  /// Frame from which on it was the reference.
  int frame_index = 0;
  /// Segment of its map.
  int segment = 0;
  /// The reference, not null.
  std::shared_ptr<const Reference> reference;
};

/// Follows the integrity of a run; for the tracking thread. Keeps the last eight references alive.
class IntegrityMonitor {
 public:
  /// What a frame shows.
  enum class Integrity {
    /// The frame is sure, and those before it are.
    kNominal,
    /// The frame or one of the nine before it is doubtful, or it follows a loss.
    kInDoubt,
    /// The first frame after a doubt that is sure with the nine before it.
    kRecovered,
  };

  /// Adds a frame with a pose, tracked against `view`, in time order.
  Integrity add(int frame_index, const TrustedReference& view, bool is_doubtful);
  /// Adds a frame without a pose.
  void add_lost();
  /// A new map. Unless it is the first one, it is in doubt until ten frames are sure and the last of them was
  /// tracked against another keyframe than the first: comparing the views that joined the map to the one
  /// before once more would say what the join said. before() is still of the map before.
  void begin_map();

  /// The last references before the doubt, or before now if there is none, newest first and none twice: a
  /// doubt can begin before it is noticed, and a camera sees again what it saw somewhat earlier. Empty before
  /// the first frame.
  const std::vector<TrustedReference>& before() const { return before_; }
  /// The first of them; nothing if there is none.
  std::optional<TrustedReference> newest_before() const {
    return before_.empty() ? std::nullopt : std::optional(before_.front());
  }

 private:
  void remember(const TrustedReference& view);
  void go_back_before(int frame_index);
  bool repeats_join(const TrustedReference& view);

  std::vector<TrustedReference> before_;
  std::optional<TrustedReference> returned_;  // by this view, in the frame before
  Integrity state_ = Integrity::kNominal;
  bool was_lost_ = false;
  bool begins_map_ = false;
  std::optional<int> joined_by_;  // keyframe that a new map was joined by
  int sure_ = 0;                  // sure frames in a row
};

}  // namespace edgevo
