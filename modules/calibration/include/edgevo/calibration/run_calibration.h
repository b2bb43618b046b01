// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The camera refined by a finished `edgevo run`, from the summary.yaml in its folder.
#include <string>

#include "edgevo/calibration/fold_residual.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Camera and self-calibration of a finished run.
struct RunCalibration {
  /// Path of the summary.yaml, for messages.
  std::string path;
  /// Camera that was given to the run.
  Camera camera;
  /// Result of self-calibration for that camera.
  CameraPosterior refinement;
  /// What the run said of k1.
  CameraPosterior::State k1_state = CameraPosterior::State::kOff;
};

/// Throws InputError: no summary.yaml in the folder, or one without a readable camera or self_calibration.
RunCalibration read_run_calibration(const std::string& run_folder);
/// The same with the camera of a file, which has all digits; empty `camera_file`: that of the summary. Throws
/// InputError if it is not the camera that the run used.
RunCalibration read_run_calibration(const std::string& run_folder, const std::string& camera_file);

/// The run's camera with its residual distortion folded in; unchanged if self-calibration found none. Throws
/// InputError, which says what to do, when self-calibration was off or undetermined: the camera was then not
/// verified.
FoldedCamera corrected_camera(const RunCalibration& run);

}  // namespace edgevo
