#pragma once
// The camera of the servo loop: what it takes at a pose, with the light and the blackout of the moment.
#include <optional>

#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/motion_plan.h"
#include "edgevo/simulation/relight.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

class SimulatedCamera {
 public:
  SimulatedCamera(const ServoParams& params, const MotionPlan& plan);

  const SceneRenderer& renderer() const { return renderer_; }
  const Camera& model() const { return renderer_.camera(); }

  /// nullopt: the camera drops the image.
  std::optional<GrayImage> take(const SE3& T_scene_cam, int index, double seconds) const;

 private:
  bool is_dark(double seconds) const { return seconds >= dark_begin_s_ && seconds < dark_end_s_; }

  SceneRenderer renderer_;
  std::optional<Relight> light_;
  double dark_begin_s_, dark_end_s_, light_begin_s_;
};

}  // namespace edgevo
