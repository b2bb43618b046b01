// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The path of a scene's camera over the ground, along which traffic moves.
#include <Eigen/Core>
#include <vector>

#include "edgevo/simulation/scene.h"

namespace edgevo {

/// A place where the path turns off: the straight lines before and after meet at `corner`.
struct Turning {
  Eigen::Vector2d corner;
  /// Unit vector, of the path after it.
  Eigen::Vector2d onwards;
  /// Seconds, when the camera begins to turn.
  double seconds;
};

/// The path, continued straight at both ends.
class Road {
 public:
  explicit Road(const Scene& scene);

  /// Length, metres.
  double length() const { return gone_.back(); }
  /// Metres that the camera has gone at a time, in seconds.
  double gone(double seconds) const;
  /// Pose on the ground, axes as in body.h, `s` metres along the path, `left` metres left of it.
  SE3 at(double s, double left) const;
  /// Where it turns by more than 45 degrees within 25 m.
  std::vector<Turning> turnings() const;

 private:
  Eigen::Vector2d point(double s) const;
  Eigen::Vector2d direction(double s) const;

  double step_s_;
  std::vector<Eigen::Vector2d> points_;  // at equal steps of time
  std::vector<double> gone_;
};

/// Pose on the ground at `p`, x towards `forward`.
SE3 on_ground(const Eigen::Vector2d& p, const Eigen::Vector2d& forward);

/// Makes the camera stand: it slows down until the present scene's time `at`, stands for `seconds`, and goes
/// on. All is later then, and there are more frames.
void stop_camera(double at, double seconds, Scene* scene);

}  // namespace edgevo
