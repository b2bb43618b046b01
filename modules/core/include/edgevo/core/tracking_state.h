#pragma once
// The verdict for a frame.
#include <string_view>

namespace edgevo {

/// How far a frame's pose can be trusted.
enum class TrackingState {
  kBootstrapping,  ///< no map yet; a pose may be filled in afterwards
  kTracking,       ///< pose and map are good
  kDegraded,       ///< a pose, but with few inliers or badly observed directions: use with its covariance
  kLost,           ///< no pose; the segment is closed and a new bootstrap begins
};

/// "BOOTSTRAPPING", "TRACKING", "DEGRADED", "LOST".
std::string_view to_string(TrackingState state);

}  // namespace edgevo
