// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What all keyframes so far show about the camera, and what of it is applied.
#include <optional>

#include "camera_problem.h"
#include "edgevo/core/records.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

/// Outcome of an estimate.
struct CameraDecision {
  /// Knowledge after the estimate; its values are those of `estimate`, or as before.
  CameraRefinement state;
  /// The estimate, if something is to be applied.
  std::optional<CameraEstimate> estimate;
  /// Whether nothing but the focal length was weighed, since corners contradict it.
  bool is_of_focal_length = false;
};

/// Estimates the camera. Before `params.min_keyframes` only the read-out time is estimated: k1 becomes
/// observable later. From then on k1 is, and the read-out time with it if it is known already or if one more
/// step indicates a rolling shutter. Before either, the posterior of the focal length is weighed
/// (focal_length.h); where corners contradict the one in use, it alone. `known`: results of earlier
/// estimates.
CameraDecision find_camera(const CameraProblem& problem, const CameraRefinement& known,
                           const SelfCalibrationParams& params, const BaOptions& options);

}  // namespace edgevo
