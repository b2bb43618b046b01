// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/scene_renderer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "active_surfaces.h"
#include "edgevo/core/target_pinhole.h"
#include "exposure.h"
#include "image_pass.h"
#include "lens_rays.h"
#include "scene_views.h"
#include "sensor_noise.h"
#include "visibility.h"

namespace edgevo {

SceneRenderer::SceneRenderer(Scene scene)
    : scene_(std::move(scene)), rays_(std::make_shared<const LensRays>(rays_through_lens(scene_.camera))) {
  check_shutter(scene_);
}

Pinhole SceneRenderer::undistorted() const { return target_pinhole(scene_.camera); }

SE3 SceneRenderer::T_world_cam(int index) const {
  return scene_.T_scene_cam.front().inverse() * scene_.T_scene_cam[size_t(index)];
}

GrayImage SceneRenderer::render_image(int index) const {
  const int instants =
      scene_.shutter.exposure_s > 0 ? instants_of_exposure(scene_, index, render_depth(index)) : 1;
  const std::vector<float> gray = expose(scene_, *rays_, index, instants);
  const Pinhole p = scene_.camera.pinhole();
  return {p.width, p.height, with_sensor_noise(gray, scene_.noise_sigma, scene_.seed, index)};
}

GrayImage SceneRenderer::render_image_from(const SE3& T_scene_cam, int index) const {
  const Pinhole p = scene_.camera.pinhole();
  std::vector<float> gray(size_t(p.width) * p.height);
  add_rows_seen(scene_, *rays_, {T_scene_cam, seconds_of_frame(scene_, index)}, {0, p.height}, &gray);
  return {p.width, p.height, with_sensor_noise(gray, scene_.noise_sigma, scene_.seed, index)};
}

std::vector<float> SceneRenderer::render_depth(int index) const {
  const int height = undistorted().height;
  return depth_of(view_scene(scene_, Camera(undistorted()), instant_of(scene_, index), {0, height}).surfaces);
}

std::vector<float> SceneRenderer::render_depth_from(const SE3& T_scene_cam) const {
  const int height = undistorted().height;
  return depth_of(view_surfaces(*scene_.world, Camera(undistorted()), T_scene_cam, {0, height}));
}

GrayImage SceneRenderer::render_bodies(int index) const {
  const Pinhole p = scene_.camera.pinhole();
  return {p.width, p.height, bodies_in(scene_, *rays_, index)};
}

GrayImage SceneRenderer::render_things(int index) const {
  const Pinhole p = undistorted();
  const SceneViews views = view_scene(scene_, Camera(p), instant_of(scene_, index), {0, p.height});
  GrayImage things{p.width, p.height, {}};
  things.pixels.reserve(size_t(p.width) * p.height);
  each_pixel(views.surfaces, [&](const ViewSurface* s, const Eigen::Vector2d&) {
    const bool is_body = s && views.body[size_t(s - views.surfaces.data())] != kNoBody;
    things.pixels.push_back(!s ? kNoThing : uint8_t(is_body ? Thing::kObject : s->surface->thing));
  });
  return things;
}

std::vector<float> SceneRenderer::depth_of(const std::vector<ViewSurface>& views) const {
  const Pinhole p = undistorted();
  std::vector<float> depth;
  depth.reserve(size_t(p.width) * p.height);
  each_pixel(views, [&](const ViewSurface* s, const Eigen::Vector2d& px) {
    depth.push_back(s ? float(1 / s->idepth.dot(p.ray(px))) : 0.0f);
  });
  return depth;
}

void SceneRenderer::each_pixel(
    const std::vector<ViewSurface>& views,
    const std::function<void(const ViewSurface* surface, const Eigen::Vector2d& px)>& see) const {
  const Pinhole p = undistorted();
  RowSamples row(p.width, 1);
  set_sample_columns(p, 1, &row);
  ActiveSurfaces active(views);
  for (int v = 0; v < p.height; ++v) {
    row.clear();
    active.for_row(v, [&](const ViewSurface& view, int id) { draw_pinhole(view, id, p, v, 0, &row); });
    for (int u = 0; u < p.width; ++u) {
      const int owner = row.owner_of(0)[u];
      see(owner < 0 ? nullptr : &views[size_t(owner)], {double(u), double(v)});
    }
  }
}

RenderedFrame SceneRenderer::render(int index) const {
  return {index, scene_.times[size_t(index)], render_image(index), render_depth(index), T_world_cam(index)};
}

}  // namespace edgevo
