// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// When the motion is in doubt, when it is sure again, and what was seen before the doubt.
//
// p_right of a frame speaks of the motion over the ten frames up to it. So a doubtful frame throws doubt on
// these ten, and health has returned once ten frames in a row are sure: their p_right speaks of nothing that
// was doubted. Between the two the map may have changed its unit.
#include <deque>
#include <memory>
#include <optional>

#include "edgevo/odometry/reference.h"

namespace edgevo {

/// Frames that p_right speaks of.
constexpr int kDoubtReach = 10;

/// What a frame was tracked against.
struct SureView {
  /// Frame from which on it was the reference.
  int frame_index = 0;
  /// Segment of its map.
  int segment = 0;
  /// The reference, not null.
  std::shared_ptr<const Reference> reference;
};

/// Follows the health of a run; for the tracking thread. Keeps the references of the last ten frames, and the
/// one before them, alive.
class HealthWatch {
 public:
  /// What a frame shows.
  enum class Health {
    /// The frame is sure, and those before it are.
    kSure,
    /// The frame or one of the nine before it is doubtful, or it follows a loss.
    kInDoubt,
    /// The first frame after a doubt that is sure with the nine before it.
    kReturned,
  };

  /// Adds a frame with a pose, tracked against `view`, in time order.
  Health add(int frame_index, const SureView& view, bool is_doubtful);
  /// Adds a frame without a pose.
  void add_lost();
  /// A new map. Unless it is the first one, it is in doubt until ten frames are sure and the last of them was
  /// tracked against another keyframe than the first: comparing the views that joined the map to the one
  /// before once more would say what the join said. before() is still of the map before.
  void begin_map();

  /// The last reference before the doubt, or before now if there is none; nothing before the first frame.
  const std::optional<SureView>& before() const { return before_; }

 private:
  void go_back_before(int frame_index);
  bool repeats_join(const SureView& view);

  std::deque<SureView> recent_;
  std::optional<SureView> before_;
  Health state_ = Health::kSure;
  bool was_lost_ = false;
  bool begins_map_ = false;
  std::optional<int> joined_by_;  // keyframe that a new map was joined by
  int sure_ = 0;                  // sure frames in a row
};

}  // namespace edgevo
