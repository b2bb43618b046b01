// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The focal length by all evidence together: what the file says, what corners show (focal_by_corners.h), and
// the matches of the map.
#include "camera_problem.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Whether an estimate is at its limit (kMaxFocalError): the true one may be larger still, and it does not
/// count.
bool is_at_limit(double focal);

/// Whether corners contradict the focal length in use, by a window that was not weighed against the map yet.
bool do_corners_contradict(const CameraPosterior& known);

/// The search for the whole lens by the matches and the file, and for the read-out time if it is
/// `with_readout`. It starts at the camera in use, but at the focal length of corners where they contradict
/// that. `readout_s`: by the file.
CameraSearch search_for_camera(const CameraPosterior& known, bool with_readout, double readout_s);

/// A focal length (ImageCorrection::focal) by all evidence.
struct FocalPosterior {
  /// Mean and standard deviation.
  double mean = 0, sigma = 0;
  /// Its standard deviation if the focal length in use is right: then matches are not biased.
  double sigma_in_use = 0;
  /// Whether the matches alone are off the file by more than their standard deviation, to the same side:
  /// corners that slide over what is smooth or moves do not change a camera alone.
  bool do_matches_agree = false;
};

/// That of the matches, of which `e` was found by search_for_camera(), together with what corners show.
/// Matches were found with the camera in use and are biased towards it, the more the further they are from
/// it.
FocalPosterior focal_posterior(const CameraPosterior& known, const CameraEstimate& e);

/// `problem` as cameras of the focal lengths `before` and, returned, `now` (ImageCorrection::focal) see it,
/// to first order: where an adjustment with `now` starts. Depths stay.
CameraProblem seen_with_focal_length(CameraProblem problem, double before, double now);

/// `problem` with the poses and depths of a solution of it.
CameraProblem started_at(CameraProblem problem, const BaProblem& solution);

}  // namespace edgevo
