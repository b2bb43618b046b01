// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// All keyframes so far as one problem in the camera file's images.
#include <vector>

#include "camera_problem.h"
#include "edgevo/map/map.h"

namespace edgevo {

/// All keyframes as one problem.
struct CalibrationHistory {
  /// The problem.
  CameraProblem problem;
  /// Index of a point in the problem, as [keyframe][point]; -1: not in it.
  std::vector<std::vector<int>> point_index;
};

/// The keyframes of the present segment that have matches, by id.
std::vector<const Keyframe*> all_keyframes(const Map& map);

/// Builds the problem. `now`: correction of the keyframes' images.
CalibrationHistory make_history(const Rectification& rectification, const ImageCorrection& now,
                                const std::vector<const Keyframe*>& keyframes);

/// Applies the solution of an estimate on `then` to the keyframes and points of `now`, which begins with
/// those of `then`. Later keyframes and points keep their motion against the newest known keyframe, in the
/// unit of length that the solution has there.
BaProblem carry_over(const CalibrationHistory& then, const CameraEstimate& estimate,
                     const CalibrationHistory& now);

}  // namespace edgevo
