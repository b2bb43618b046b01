// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which frames are not to be trusted.
#include "edgevo/core/records.h"

namespace edgevo {

/// Value of FrameRecord::p_right below which a frame is doubtful. At most 2 % of the frames whose motion is
/// right have a lower one, on cameras that the fit had not seen (split conformal;
/// share/training/fit_trust.cpp).
inline constexpr double kDoubtfulBelow = 0.7076;

/// Whether the motion around the frame is not to be trusted: p_right is known and below kDoubtfulBelow, or
/// the frame is LOST, or DEGRADED for too few edges that agree with its pose.
inline bool is_doubtful(const FrameRecord& frame) {
  return frame.state == TrackingState::kLost || frame.state == TrackingState::kDegraded ||
         frame.p_right < kDoubtfulBelow;  // false for NaN
}

}  // namespace edgevo
