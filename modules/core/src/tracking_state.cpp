// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/tracking_state.h"

namespace edgevo {

std::string_view to_string(TrackingState state) {
  switch (state) {
    case TrackingState::kBootstrapping:
      return "BOOTSTRAPPING";
    case TrackingState::kTracking:
      return "TRACKING";
    case TrackingState::kDegraded:
      return "DEGRADED";
    case TrackingState::kLost:
      return "LOST";
  }
  return "?";
}

}  // namespace edgevo
