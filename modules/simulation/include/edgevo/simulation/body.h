// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What moves through a scene by itself.
#include <functional>
#include <memory>

#include "edgevo/core/se3.h"
#include "edgevo/simulation/world.h"

namespace edgevo {

/// A rigid body that moves by itself: a small world in axes of its own.
struct Body {
  /// Its surfaces; x forward, y left, z up, metres, with the origin on the ground below its middle. Its sky
  /// is not used.
  std::shared_ptr<const World> parts;
  /// Pose at any time in seconds.
  std::function<SE3(double)> T_scene_body;
};

}  // namespace edgevo
