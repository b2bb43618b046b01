// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The camera of the servo loop: images at a pose, with the current light and blackout.
#include <optional>

#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/motion_plan.h"
#include "edgevo/simulation/relight.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// Renders the images of the loop.
class SimulatedCamera {
 public:
  SimulatedCamera(const ServoParams& params, const MotionPlan& plan);

  /// Renderer without light changes and blackout.
  const SceneRenderer& renderer() const { return renderer_; }
  /// Camera of the images.
  const Camera& model() const { return renderer_.camera(); }

  /// Begins the darkness at this time, of a loop that steers to a kept goal: when it will be found is not
  /// known.
  void begin_darkness(double seconds) { dark_begin_s_ = seconds; }
  /// How far the darkness has gone, from 0 to 1; nothing outside of it.
  std::optional<double> darkness(double seconds) const {
    if (!is_dark(seconds)) return std::nullopt;
    return (seconds - dark_begin_s_) / blackout_s_;
  }

  /// Image number `index` at a pose; nullopt: the camera drops it.
  std::optional<GrayImage> take(const SE3& T_scene_cam, int index, double seconds) const;

 private:
  bool is_dark(double seconds) const {
    return seconds >= dark_begin_s_ && seconds < dark_begin_s_ + blackout_s_;
  }

  SceneRenderer renderer_;
  std::optional<Relight> light_;
  double dark_begin_s_, blackout_s_, light_begin_s_;
};

}  // namespace edgevo
