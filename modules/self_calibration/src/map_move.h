// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How keyframes move when the camera is corrected.
#include <vector>

#include "edgevo/map/map_event.h"
#include "history.h"

namespace edgevo {

/// The solution of `e` as a move of all keyframes, anchored at the newest one. The first `marginalised`
/// keyframes are no longer in the window; their information on the window becomes its prior. Leaves the
/// segment open.
MapMoved make_move(const Rectification& rectification, const ImageCorrection& before,
                   const std::vector<const Keyframe*>& keyframes, size_t marginalised,
                   const CalibrationHistory& history, const BaOptions& options, CameraEstimate* e);

}  // namespace edgevo
