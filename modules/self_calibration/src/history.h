#pragma once
// All keyframes so far as one problem in the camera file's images.
#include <vector>

#include "camera_problem.h"
#include "edgevo/mapping/keyframe.h"

namespace edgevo {

/// Keyframes as one problem in the camera file's images.
struct CalibrationHistory {
  CameraProblem problem;
  std::vector<std::vector<int>> point_index;  ///< [keyframe][point] -> problem point, -1: none
};

/// `now`: what the keyframes' images are corrected for.
CalibrationHistory make_history(const Pinhole& pinhole, const ImageCorrection& now,
                                const std::vector<const Keyframe*>& keyframes);

/// The solution of an estimate on `then` for the keyframes and points of `now`, which begins with those of
/// `then`. A keyframe that came later keeps its motion against the newest known one, in the solution's unit
/// there, and so does a point.
BaProblem carry_over(const CalibrationHistory& then, const CameraEstimate& estimate,
                     const CalibrationHistory& now);

}  // namespace edgevo
