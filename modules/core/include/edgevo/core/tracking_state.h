#pragma once
// The tracking status of a frame.
#include <string_view>

namespace edgevo {

/// How far a frame's pose can be trusted.
enum class TrackingState {
  kBootstrapping,  ///< no map yet; a pose may be filled in afterwards
  kTracking,       ///< pose and map are good
  kDegraded,       ///< a pose, but with few inliers or badly observed directions: use with its covariance
  kLost,           ///< no pose; the old map is tried for some frames more while a bootstrap runs
};

/// "BOOTSTRAPPING", "TRACKING", "DEGRADED", "LOST".
std::string_view to_string(TrackingState state);

}  // namespace edgevo
