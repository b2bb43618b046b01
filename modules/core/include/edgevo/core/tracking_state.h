// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tracking status of a frame.
#include <string_view>

namespace edgevo {

/// Reliability of a frame's pose.
enum class TrackingState {
  /// No map yet; a pose may be filled in afterwards.
  kBootstrapping,
  /// The pose and the map are good.
  kTracking,
  /// The pose has few inliers, or its motion is in doubt: use it with its covariance.
  kDegraded,
  /// No pose; relocalisation in the old map is tried for some more frames while a bootstrap runs.
  kLost,
};

/// Name of the state: "BOOTSTRAPPING", "TRACKING", "DEGRADED", "LOST".
std::string_view to_string(TrackingState state);

}  // namespace edgevo
