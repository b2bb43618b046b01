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
  /// Knowledge after the estimate; what it applies is that of `estimate`, or as before.
  CameraPosterior state;
  /// The estimate, if something is to be applied.
  std::optional<CameraEstimate> estimate;
};

/// Estimates the camera. First the posterior of all its numbers is weighed for the focal length
/// (focal_length.h), unless the map is in doubt and corners do not say that it is so because of that; then
/// that of k1 and the read-out time with the focal length given. By either a number is applied where the
/// file's is improbable and keyframes held back do not speak against it, and given up where it no longer is.
/// `known`: results of earlier estimates.
CameraDecision find_camera(const CameraProblem& problem, const CameraPosterior& known,
                           const SelfCalibrationParams& params, const BaOptions& options);

}  // namespace edgevo
