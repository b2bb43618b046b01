#pragma once
// The camera that a finished `edgevo run` has found, from the summary.yaml in its folder.
#include <string>

#include "edgevo/calibration/fold_residual.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// The camera of a finished run.
struct RunCalibration {
  std::string path;             ///< of the summary.yaml, for messages
  Camera camera;                ///< that the run was given
  CameraRefinement refinement;  ///< what self-calibration says about it
};

/// Throws InputError: no summary.yaml in the folder, or one without a readable camera or self_calibration.
RunCalibration read_run_calibration(const std::string& run_folder);

/// The run's camera with its residual distortion folded in; unchanged where self-calibration found none.
/// Throws InputError, which says what to do, when self-calibration was off or could not tell: then nobody
/// knows whether the camera is right.
FoldedCamera corrected_camera(const RunCalibration& run);

}  // namespace edgevo
