#pragma once
// What all keyframes so far say about the camera, and what of it is applied.
#include <optional>

#include "camera_problem.h"
#include "edgevo/core/records.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

struct CameraFinding {
  /// What is known now; its values are those of `estimate`, else as before.
  CameraRefinement state;
  std::optional<CameraEstimate> estimate;  ///< where something is to be applied
};

/// Before `params.min_keyframes` only the read-out time is estimated: k1 shows later. From then on k1, and the
/// read-out time with it where it is known already or one more step makes the shutter look like a rolling
/// one. `known`: what earlier estimates found.
CameraFinding find_camera(const CameraProblem& problem, const CameraRefinement& known,
                          const SelfCalibrationParams& params, const BaOptions& options);

}  // namespace edgevo
