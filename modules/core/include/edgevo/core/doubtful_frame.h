// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which frames are not to be trusted.
#include "edgevo/core/records.h"

namespace edgevo {

/// Value of FrameRecord::p_right below which a frame is doubtful. At most 2 % of the frames whose motion is
/// right have a lower one, on cameras that the fit had not seen (split conformal;
/// share/training/fit_trust.cpp).
inline constexpr double kDoubtfulBelow = 0.7149;

/// Whether the frame throws doubt on the map: p_right is known and below kDoubtfulBelow, or it is LOST.
inline bool is_map_in_doubt(const FrameRecord& frame) {
  return frame.state == TrackingState::kLost || frame.p_right < kDoubtfulBelow;  // false for NaN
}

/// Whether the pose of the frame or the motion around it is not to be trusted: as is_map_in_doubt(), or it is
/// DEGRADED for anything else (few edges that agree).
inline bool is_doubtful(const FrameRecord& frame) {
  return frame.state == TrackingState::kDegraded || is_map_in_doubt(frame);
}

}  // namespace edgevo
