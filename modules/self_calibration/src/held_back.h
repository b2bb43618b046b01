// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Does an estimated camera explain what it was not made of?
#include "camera_problem.h"

namespace edgevo {

/// By how much one camera explains held-back matches better than another.
struct HeldBack {
  /// Mean over the held-back keyframes of the difference in robust cost, sigmas squared a keyframe: one with
  /// few matches says little. And its standard error. Positive: the estimate is better.
  double gain = 0, standard_error = 0;
  /// Number of keyframes that were held back.
  int keyframes = 0;

  /// Whether the estimate counts: unless what was held back speaks against it by more than chance. That it
  /// is better by more than chance is for its significance to say: the difference in cost is of second order,
  /// and its sign alone rejected every third right estimate.
  bool allows_estimate() const { return keyframes > 0 && gain >= -kImprobable * standard_error; }
};

/// Compares the estimate `e` with `file`, the camera file's correction. The matches in every fifth keyframe
/// are held back: depths and all other poses are adjusted without them under each of the two, then these
/// keyframes are placed by them and the costs compared. Cost: about five solves.
HeldBack compare_on_held_back(const CameraProblem& problem, const CameraEstimate& e, const CameraError& file,
                              const BaOptions& options);

}  // namespace edgevo
