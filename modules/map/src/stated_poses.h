// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which of several statements about one pose hold: a guess, and what views show. Scenes repeat themselves, so
// that a view can show a place that looks alike; how common that is, is not known before.
#include <optional>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/map/map_graph.h"

namespace edgevo {

/// Where a camera lies in a frame.
struct StatedPose {
  /// Its pose.
  SE3 T_frame_cam;
  /// Covariance of [p, w]: position in the frame, and rotation about the frame's axes, radians.
  Matrix6d covariance = Matrix6d::Identity();
};

/// What the constraints from one frame to the next, in one unit of length, say of a camera in the last: the
/// pose in the first frame.
StatedPose state_pose(const std::vector<Constraint>& constraints, const SE3& T_last_cam);

/// A guess that can fail.
struct GuessedPose {
  /// The guess.
  StatedPose stated;
  /// Probability that it fails, in [0, 1); 0: it cannot.
  double fails = 0;
};

/// What is known of views: Beta distribution of the probability that one is mistaken.
struct MistakenViews {
  /// Its parameters, > 0: as if so many views had been mistaken, and right.
  double mistaken = 1, right = 1;
};

/// Where a camera may be, about the guess, that a mistaken view or a failed guess shows: standard deviations.
struct UnknownPose {
  /// Of the position, in the frame's unit, and of the rotation, radians.
  double position = 1, rotation = 1;
};

/// The views that hold, of the most probable choice. With y_k the statements, m of n views mistaken, a and b
/// the parameters of `known`, and U the density of an unknown pose, a choice S of those that hold has the
/// probability
///     B(a + m, b + n - m) / B(a, b) int prod_{k in S} N(y_k; x, Sigma_k) dx U^(number not in S)
/// times that of the guess. The choices that are compared grow from one statement, by the one that gains
/// most. Cost: cubic in the number of views.
std::vector<bool> views_that_hold(const std::vector<StatedPose>& views,
                                  const std::optional<GuessedPose>& guess, const MistakenViews& known,
                                  const UnknownPose& unknown);

}  // namespace edgevo
