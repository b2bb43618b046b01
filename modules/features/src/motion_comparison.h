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
  /// Adds a frame: the step of the corners, and T_cam_odometry, the camera in the frame of the odometry's
  /// path; nothing: the odometry has no pose there.
  void add(const ChainStep& step, const std::optional<SE3>& T_cam_odometry);
  /// Forgets the poses of the odometry but that of the newest frame: another map has another unit.
  void restart_odometry(const SE3& newest);

  /// Unit of the corners' path per unit of the odometry, from the last frames; nothing: unknown.
  std::optional<double> unit() const;
  /// Everything that the two paths say, the other fields of the evidence left as they are.
  void compare(CornerEvidence* evidence) const;
  /// FeatureTracker::turn().
  std::optional<CornerTurn> turn() const;

 private:
  struct Entry {
    ChainStep step;
    std::optional<SE3> T_cam_odometry;
  };
  // Logarithm of the ratio of the two paths' extents, with its standard deviation.
  struct Ratio {
    double log = 0, sigma = 0;
  };
  std::optional<Ratio> ratio(int first, int last) const;
  void compare_motion(const Ratio& before, CornerEvidence* evidence) const;
  void compare_rotation(CornerEvidence* evidence) const;
  double drift(int first, int last) const;

  std::deque<Entry> entries_;
};

}  // namespace edgevo
