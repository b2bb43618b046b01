// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The marginalised keyframes that a window shows, from the events of the run.
#include <map>
#include <memory>
#include <vector>

#include "edgevo/map/epochs.h"

namespace edgevo {

/// A copy of the marginalised keyframes that follows the map. Records are shared with the map until they
/// move.
class ViewKeyframes {
 public:
  /// Applies the next event. `pinhole`: that of the undistorted images.
  void apply(const Pinhole& pinhole, const MapEvent& event);

  /// Number of keyframes so far.
  size_t size() const { return keyframes_.size(); }
  /// The i-th of them, in the order of their marginalisation, in the frame of live poses, which the camera is
  /// drawn in. Cost: a copy.
  KeyframeRecord in_live_frame(size_t i) const;
  /// Changes whenever keyframes that are here have moved.
  int moves() const { return moves_; }

 private:
  void move(const Pinhole& pinhole, const MapMoved& moved);

  /// In their segments' maps.
  std::vector<std::shared_ptr<const KeyframeRecord>> keyframes_;
  /// Place in keyframes_ by id.
  std::map<int, size_t> place_;
  /// Their ids.
  std::vector<int> ids_;
  PlacedEpochs placed_;
  SE3 T_odom_world_;  // EpochsPlaced
  int moves_ = 0;
};

}  // namespace edgevo
