// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keyframes with what is remembered of their views, along one path: of this run, or of a map that was kept.
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/map/map_event.h"
#include "edgevo/map/path_drift.h"
#include "edgevo/places/remembered_view.h"

namespace edgevo {

/// A keyframe that has left the window.
struct StoredKeyframe {
  /// Id of the keyframe, and number of its epoch in the run: within one the unit of length is one.
  int id = 0, epoch = 0;
  /// The keyframe: T_world_cam is its pose in the map of its segment.
  std::shared_ptr<const KeyframeRecord> record;
  /// What is remembered of its view; null: nothing.
  std::shared_ptr<const RememberedView> view;
  /// The motion to the keyframe after it, if known.
  std::optional<NeighbourPose> next;
};

/// Keyframes in the order of time. For one thread at a time; several may read it.
class PlaceStore {
 public:
  /// `pinhole`: that of the rectified images.
  explicit PlaceStore(const Pinhole& pinhole) : pinhole_(pinhole) {}

  /// Appends a keyframe; ids ascend.
  void add(StoredKeyframe keyframe) { keyframes_.push_back(std::move(keyframe)); }
  /// Gives a keyframe its state of now; its view stays if that has none.
  void update(size_t at, StoredKeyframe now) {
    if (!now.view) now.view = keyframes_[at].view;
    keyframes_[at] = std::move(now);
  }
  /// The keyframes; positions in this vector name them below.
  const std::vector<StoredKeyframe>& keyframes() const { return keyframes_; }
  /// Number of keyframes.
  size_t size() const { return keyframes_.size(); }
  /// Pinhole of the rectified images.
  const Pinhole& pinhole() const { return pinhole_; }

  /// Numbers the epochs anew, by the ids of their first keyframes.
  void number_epochs(const std::set<int>& first_keyframes);
  /// Moves the keyframes that the move names.
  void move(const Rectification& rectification, const MapMoved& moved);

  /// Whether the unit of length is one for both.
  bool is_one_unit(size_t a, size_t b) const { return keyframes_[a].epoch == keyframes_[b].epoch; }
  /// Motion from one keyframe to another of the same epoch.
  SE3 T_a_b(size_t a, size_t b) const { return pose(a).inverse() * pose(b); }
  /// Covariance of xi in T_a_b <- exp(xi) T_a_b: what the path between them, of one epoch, may be off by.
  /// Cost: a microsecond for each keyframe between.
  Matrix7d path_covariance(size_t a, size_t b) const;
  /// Points of the map around a keyframe, of its epoch, in its frame: those that it and a few keyframes
  /// before and after it host, as it may see them. Cost: about 0.2 ms.
  std::vector<CloudPoint> points_around(size_t at) const;

  /// Keyframes before and after one whose points count as around it.
  static constexpr size_t kAround = 5;

 private:
  SE3 pose(size_t at) const { return keyframes_[at].record->T_world_cam; }

  Pinhole pinhole_;
  std::vector<StoredKeyframe> keyframes_;
};

}  // namespace edgevo
