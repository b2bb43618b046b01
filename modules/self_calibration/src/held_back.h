// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Does an estimated camera explain what it was not made of?
#include "camera_problem.h"

namespace edgevo {

/// By how much one camera explains held-back matches better than another.
struct HeldBack {
  /// Mean over the held-back keyframes of the difference in robust cost, sigmas squared per match. Positive:
  /// the estimate is better.
  double gain = 0;
  /// Number of keyframes that were held back.
  int keyframes = 0;

  /// Whether the estimate is better. Whether by more than chance is for its significance to say: asking it
  /// again here rejects right read-out times at ten keyframes, of which two are held back.
  bool is_better() const { return keyframes > 0 && gain > 0; }
};

/// Compares the estimate `e` with `file`, the camera file's correction. The matches in every fifth keyframe
/// are held back: depths and all other poses are adjusted without them under each of the two, then they are
/// placed by their matches and these compared. Cost: about four solves.
HeldBack compare_on_held_back(const CameraProblem& problem, const CameraEstimate& e,
                              const ImageCorrection& file, const BaOptions& options);

}  // namespace edgevo
