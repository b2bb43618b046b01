// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The course of the camera through a doubt, from the last keyframe before it to the first one after it.
#include <vector>

#include "edgevo/map/epochs.h"

namespace edgevo {

/// Keyframes in which the unit of length goes over from one to another.
class DoubtfulCourse {
 public:
  /// `keyframes`: of one map, in their order; the unit is known at the first and at the last. `doubt`:
  /// RunSoFar::doubt.
  DoubtfulCourse(std::vector<KeyframeInMap> keyframes, const std::function<double(int, int)>& doubt);

  /// Position of the last keyframe in the map of the first one, if lengths there are `ratio` times those in
  /// the map: each step has the mean unit of its ends.
  Eigen::Vector3d end(double ratio) const;
  /// Length of the course, as it is in the map.
  double length() const;
  /// Number of frames that it takes.
  int frames() const;

  /// From the map to the world for each keyframe, where the first one lies by `T_world_first` and the last
  /// one by `T_world_last`: what chaining the steps leaves open is spread as the unit is.
  std::vector<Sim3> place(const Sim3& T_world_first, const Sim3& T_world_last) const;
  /// The keyframes.
  const std::vector<KeyframeInMap>& keyframes() const { return keyframes_; }

 private:
  std::vector<Eigen::Vector3d> chain(double ratio) const;

  std::vector<KeyframeInMap> keyframes_;
  std::vector<double> progress_;  // 0 at the first keyframe, 1 at the last
};

}  // namespace edgevo
