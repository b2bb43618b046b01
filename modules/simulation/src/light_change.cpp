// SPDX-License-Identifier: BSD-3-Clause
#include "light_change.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "world_builder.h"

namespace edgevo {
namespace {

// Brightness of a surface in the sun; `shade` and `sun` as in SecondLightParams.
double brightness(const Surface& s, const Eigen::Vector3d& sun_direction, double shade, double sun) {
  const Eigen::Vector3d normal = s.side_v.cross(s.side_u).normalized();
  return shade + sun * std::max(0.0, normal.dot(sun_direction));
}

std::shared_ptr<const GroundShadow> shadow_of(const World& world, const Eigen::Vector3d& sun_direction,
                                              double shade, double sun) {
  GroundShadow shadow = ground_shadow(world, sun_direction);
  shadow.shade = float(shade / (shade + sun * sun_direction.z()));
  return std::make_shared<const GroundShadow>(std::move(shadow));
}

}  // namespace

Eigen::Vector3d sun_direction(double azimuth_deg, double elevation_deg) {
  const double a = rad(azimuth_deg), e = rad(elevation_deg);
  return {std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)};
}

LightChange make_light_change(const SceneParams& params, const World& world) {
  const WorldParams& w = params.world;
  const SecondLightParams& l = params.second_light;
  const Eigen::Vector3d from = sun_direction(w.sun_azimuth_deg, w.sun_elevation_deg),
                        to = sun_direction(l.sun_azimuth_deg, l.sun_elevation_deg);
  LightChange change{
      {{}, 1, world.sky.gray, world.sky.haze_per_metre, shadow_of(world, from, kInShade, kBySun)},
      {{},
       float(l.exposure),
       float(l.horizon_gray),
       float(l.haze_per_metre),
       shadow_of(world, to, l.shade, l.sun)},
      l.begins_s,
      l.duration_s};
  for (const Surface& s : world.surfaces)
    change.second.gain.push_back(
        float(brightness(s, to, l.shade, l.sun) / brightness(s, from, kInShade, kBySun)));
  return change;
}

double LightChange::share(double seconds) const {
  if (seconds <= begins_s) return 0;
  if (seconds >= begins_s + duration_s) return 1;
  const double t = (seconds - begins_s) / duration_s;
  return t * t * (3 - 2 * t);
}

}  // namespace edgevo
