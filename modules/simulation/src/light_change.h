// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The lights of a scene, from its parameters and its world.
#include "edgevo/simulation/light.h"
#include "edgevo/simulation/world.h"
#include "scene_params.h"

namespace edgevo {

/// The change from the light of `params.world`, in which `world` was built, to `params.second_light`. Cost:
/// half a second for the shadows of a few streets.
LightChange make_light_change(const SceneParams& params, const World& world);

/// Direction towards a sun, a unit vector in scene axes.
Eigen::Vector3d sun_direction(double azimuth_deg, double elevation_deg);

/// Shadows that the surfaces of `world` cast on the plane z = 0 and what lies just above it.
GroundShadow ground_shadow(const World& world, const Eigen::Vector3d& sun);

}  // namespace edgevo
