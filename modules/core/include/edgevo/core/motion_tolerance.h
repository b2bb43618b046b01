// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a right motion is: the one definition that the evaluation against ground truth uses, and that p_right
// is a probability of.

namespace edgevo {

/// Bounds on the error of the motion over some frames. A translation is wrong above both of its bounds, a
/// motion if its translation or its rotation is.
struct MotionTolerance {
  /// Frames that the motion spans.
  int frames = 10;
  /// Error of the translation, as a share of its length, and of the median depth of the map.
  double share_of_length = 0.25, share_of_depth = 0.02;
  /// Error of the rotation, degrees.
  double rotation_deg = 3;
};
/// The bounds in use; chosen, not fitted.
inline constexpr MotionTolerance kMotionTolerance;
/// Median depths a frame up to which a step is a small one: over all frames of a motion it stays within the
/// tolerance. A camera that stands still may start to move, and what is usual until then says nothing.
inline constexpr double kSmallStep = kMotionTolerance.share_of_depth / kMotionTolerance.frames;

}  // namespace edgevo
