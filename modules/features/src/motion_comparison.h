// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Compares two paths of one camera, each in a unit of its own: that of the odometry with that of the corners.
#include <deque>
#include <optional>

#include "corner_chain.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/features/feature_tracker.h"

namespace edgevo {

/// The newest part of both paths.
class MotionComparison {
 public:
  /// A frame on its paths.
  struct Entry {
    /// That of the corners.
    ChainStep step;
    /// Those of the odometry: as tracked from frame to frame, and as reported, with what mapping has moved.
    /// Nothing: the odometry has no pose there.
    std::optional<SE3> T_cam_tracked, T_cam_reported;
  };

  /// Adds a frame.
  void add(const Entry& entry);
  /// Forgets the poses of the odometry: another map has another unit.
  void forget_odometry();

  /// Unit of the corners' path per unit of the odometry as tracked, from the last frames; nothing: unknown.
  std::optional<double> unit() const;
  /// Everything that the two paths say, the other fields of the evidence left as they are.
  void compare(CornerEvidence* evidence) const;

 private:
  using OdometryPose = std::optional<SE3> Entry::*;
  // Logarithm of the ratio of the two paths' extents, with its standard deviation.
  struct Ratio {
    double log = 0, sigma = 0;
  };
  std::optional<Ratio> ratio(int first, int last, OdometryPose pose = &Entry::T_cam_reported) const;
  void compare_motion(const Ratio& before, CornerEvidence* evidence) const;
  void compare_rotation(CornerEvidence* evidence) const;
  double drift(int first, int last) const;
  // Whether both ends of the ten frames are on both paths.
  bool is_measured(const Entry& from, const Entry& to) const;

  std::deque<Entry> entries_;
};

}  // namespace edgevo
