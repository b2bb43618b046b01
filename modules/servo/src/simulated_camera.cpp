// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_camera.h"

#include <limits>

namespace edgevo {

SimulatedCamera::SimulatedCamera(const ServoParams& params, const MotionPlan& plan)
    : renderer_(load_scene("desk")),
      dark_begin_s_(params.map.empty() ? plan.teach_s + plan.away_s + params.blackout_at_s
                                       : std::numeric_limits<double>::infinity()),
      blackout_s_(params.blackout_s),
      light_begin_s_(plan.teach_s) {
  if (!params.light.empty()) light_.emplace(params.light, params.seed);
}

std::optional<GrayImage> SimulatedCamera::take(const SE3& T_scene_cam, int index, double seconds) const {
  const Pinhole p = model().pinhole();
  if (is_dark(seconds)) return GrayImage{p.width, p.height, std::vector<uint8_t>(size_t(p.width) * p.height)};
  const bool lit = light_ && seconds >= light_begin_s_;
  if (lit && light_->drops(index)) return std::nullopt;
  GrayImage image = renderer_.render_image_from(T_scene_cam, index);
  return lit ? light_->apply(image, index, seconds - light_begin_s_) : image;
}

}  // namespace edgevo
