// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Changes of unit and origin of a run's records.
#include <algorithm>

#include "edgevo/core/records.h"

namespace edgevo {

/// Multiplies the lengths in a frame's covariance and in its evidence by `factor` > 0; the poses are
/// unchanged.
inline void multiply_lengths(double factor, FrameRecord* frame) {
  Vector6d unit = Vector6d::Ones();
  unit.head<3>().setConstant(factor);
  frame->covariance = unit.asDiagonal() * frame->covariance * unit.asDiagonal();
  frame->evidence.median_depth *= factor;
}

/// Multiplies the depths of a keyframe's points and lines and their standard deviations by `factor` > 0; the
/// pose is unchanged.
inline void multiply_depths(double factor, KeyframeRecord* k) {
  const auto change = [factor](auto& p) {
    p.idepth = float(p.idepth / factor), p.idepth_sigma = float(p.idepth_sigma / factor);
  };
  for (EdgePoint& p : k->points) change(p);
  for (EdgeLine& line : k->lines)
    for (EdgeVertex& v : line.vertices) change(v);
}

/// Whether a map that was kept holds the run: its world is that of the map.
inline bool is_in_kept_map(const Run& run) {
  return std::any_of(run.constraints.begin(), run.constraints.end(),
                     [](const ConstraintRecord& c) { return c.from_frame < 0 && c.holds; });
}

/// Moves all poses so that the first is the identity: a correction of the map keeps the pose that was newest
/// at the time, while the world frame of a run is that of its first pose. Without a pose nothing changes.
inline void move_first_to_origin(Run* run) {
  const auto first = std::find_if(run->frames.begin(), run->frames.end(),
                                  [](const FrameRecord& f) { return f.T_world_cam.has_value(); });
  if (first == run->frames.end()) return;
  const SE3 T_first_world = first->T_world_cam->inverse();
  for (KeyframeRecord& k : run->keyframes) k.T_world_cam = T_first_world * k.T_world_cam;
  for (FrameRecord& f : run->frames)
    if (f.T_world_cam) f.T_world_cam = T_first_world * *f.T_world_cam;
}

}  // namespace edgevo
