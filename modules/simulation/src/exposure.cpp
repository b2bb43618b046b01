// SPDX-License-Identifier: BSD-3-Clause
#include "exposure.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/target_pinhole.h"
#include "image_pass.h"

namespace edgevo {
namespace {

Instant instant_near(const Scene& scene, int frame, double seconds_off) {
  if (seconds_off == 0) return instant_of(scene, frame);
  const double seconds = scene.times[size_t(frame)].seconds() + seconds_off;
  return {scene.T_scene_cam_at(seconds), seconds};
}

SE3 T_scene_cam(const Scene& scene, int frame, double seconds_off) {
  return instant_near(scene, frame, seconds_off).T_scene_cam;
}

// Instants at equal steps, one in the middle of each of `count` parts of the exposure; their mean is 0.
double instant(int k, int count, double exposure_s) { return exposure_s * ((k + 0.5) / count - 0.5); }

void check_time(const Scene& scene, const char* name, double seconds) {
  const double period = scene.size() > 1 ? seconds_between(scene.times[0], scene.times[1]) : 1;
  if (!(seconds >= 0 && seconds <= period))
    throw InputError("scene " + scene.name,
                     std::string("the ") + name + " of " + std::to_string(seconds) + " s is out of range",
                     "give 0 to " + std::to_string(period) + " s, the time between two frames");
}

}  // namespace

void check_shutter(const Scene& scene) {
  check_time(scene, "read-out of the rolling shutter", scene.shutter.rolling_s);
  check_time(scene, "exposure", scene.shutter.exposure_s);
  if ((scene.shutter.rolling_s > 0 || scene.shutter.exposure_s > 0) && !scene.T_scene_cam_at)
    throw InputError("scene " + scene.name, "has a shutter that takes time, but no motion between its frames",
                     "set Scene::T_scene_cam_at");
}

int instants_of_exposure(const Scene& scene, int frame, const std::vector<float>& depth) {
  constexpr int kGrid = 16, kMax = 32;
  constexpr double kFar = 1e6, kPixelsApart = 1.5, kShare = 0.95;
  const double half = scene.shutter.exposure_s / 2;
  const SE3 T_end_begin = T_scene_cam(scene, frame, half).inverse() * T_scene_cam(scene, frame, -half);
  const Pinhole p = target_pinhole(scene.camera);
  std::vector<double> shifts;
  for (int v = kGrid / 2; v < p.height; v += kGrid)
    for (int u = kGrid / 2; u < p.width; u += kGrid) {
      const double z = double(depth[size_t(v) * p.width + u]);
      const Eigen::Vector2d px(u, v);
      const Eigen::Vector3d moved = T_end_begin * ((z > 0 ? z : kFar) * p.ray(px));
      if (moved.z() > 0) shifts.push_back((p.project(moved) - px).norm());
    }
  if (shifts.empty()) return kMax;
  return int(std::clamp(std::ceil(quantile(std::move(shifts), kShare) / kPixelsApart), 1.0, double(kMax)));
}

std::vector<float> expose(const Scene& scene, const LensRays& rays, int frame, int instants) {
  const Pinhole p = scene.camera.pinhole();
  std::vector<float> gray(size_t(p.width) * p.height);
  const int rows_at_once = scene.shutter.rolling_s > 0 ? 1 : p.height;
  for (int k = 0; k < instants; ++k)
    for (int v = 0; v < p.height; v += rows_at_once) {
      const double seconds =
          scene.shutter.row_time(v, p.height) + instant(k, instants, scene.shutter.exposure_s);
      add_rows_seen(scene, rays, instant_near(scene, frame, seconds), {v, v + rows_at_once}, &gray);
    }
  for (float& g : gray) g /= float(instants);
  return gray;
}

std::vector<uint8_t> bodies_in(const Scene& scene, const LensRays& rays, int frame) {
  const Pinhole p = scene.camera.pinhole();
  std::vector<uint8_t> bodies(size_t(p.width) * p.height, kSceneAlone);
  const int rows_at_once = scene.shutter.rolling_s > 0 ? 1 : p.height;
  for (int v = 0; v < p.height; v += rows_at_once)
    set_rows_of_bodies(scene, rays, instant_near(scene, frame, scene.shutter.row_time(v, p.height)),
                       {v, v + rows_at_once}, &bodies);
  return bodies;
}

}  // namespace edgevo
