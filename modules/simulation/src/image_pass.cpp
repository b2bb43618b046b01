// SPDX-License-Identifier: BSD-3-Clause
#include "image_pass.h"

#include <algorithm>

#include "active_surfaces.h"
#include "shading.h"
#include "visibility.h"

namespace edgevo {
namespace {

// The image, row by row: visibility of all samples, then one shading for each surface that a pixel sees.
class ImagePass {
 public:
  ImagePass(const Scene& scene, const std::vector<Eigen::Vector2f>& rays, const SE3& T_scene_cam,
            RowRange rows)
      : pinhole_(scene.camera.pinhole()),
        rays_(rays),
        rows_(rows),
        views_(view_surfaces(*scene.world, scene.camera, T_scene_cam, rows)),
        row_(pinhole_.width, kSamples) {
    context_ = {float(1 / pinhole_.fx), float(1 / pinhole_.fy), scene.world->sky.gray,
                float(scene.world->sky.haze_per_metre)};
    has_clouds_ = scene.world->sky.texture >= 0;
    if (has_clouds_) sky_ = view_sky(*scene.world, T_scene_cam);
    set_sample_columns(pinhole_, kSamples, &row_);
  }

  // Adds to `gray`, the whole image row by row.
  void add_to(std::vector<float>* gray) {
    ActiveSurfaces active(views_);
    for (int v = rows_.begin; v < rows_.end; ++v) {
      row_.clear();
      active.for_row(v, [&](const ViewSurface& view, int id) { draw(view, id, v); });
      add_row(v, gray->data() + size_t(v) * pinhole_.width);
    }
  }

 private:
  void draw(const ViewSurface& view, int id, int v) {
    for (int s = 0; s < kSamples; ++s)
      if (rays_.empty())
        draw_pinhole(view, id, pinhole_, v, s, &row_);
      else
        draw_along_rays(view, id, rays_of(v, s), s, &row_);
  }
  const Eigen::Vector2f* rays_of(int v, int s) const {
    return rays_.data() + (size_t(v) * kSamples + size_t(s)) * size_t(pinhole_.width);
  }
  Eigen::Vector2f ray(int u, int v, int s) const {
    if (!rays_.empty()) return rays_of(v, s)[u];
    return {row_.x[size_t(s) * size_t(pinhole_.width) + size_t(u)],
            (float(v) + sample_offsets()[size_t(s)].y() - float(pinhole_.cy)) / float(pinhole_.fy)};
  }
  float shade_owner(int owner, const Eigen::Vector2f& x) const {
    if (owner >= 0) return shade(views_[size_t(owner)], context_, x.x(), x.y());
    return has_clouds_ ? shade_sky(sky_, context_, x.x(), x.y()) : context_.haze_gray;
  }
  // A pixel that sees several surfaces: each is shaded at the mean of its samples and counts by their number.
  float shade_mixed(int u, int v) {
    bool done[kSamples] = {};
    float sum = 0;
    for (int s = 0; s < kSamples; ++s) {
      if (done[s]) continue;
      const int owner = row_.owner_of(s)[u];
      Eigen::Vector2f mean = Eigen::Vector2f::Zero();
      int count = 0;
      for (int t = s; t < kSamples; ++t)
        if (row_.owner_of(t)[u] == owner) mean += ray(u, v, t), ++count, done[t] = true;
      sum += float(count) * shade_owner(owner, mean / float(count));
    }
    return sum / float(kSamples);
  }
  void add_row(int v, float* gray) {
    std::fill(mixed_.begin(), mixed_.end(), 0);
    const int32_t* centre = row_.owner_of(0);
    for (int s = 1; s < kSamples; ++s) {
      const int32_t* other = row_.owner_of(s);
      for (int u = 0; u < pinhole_.width; ++u) mixed_[size_t(u)] |= centre[u] ^ other[u];
    }
    for (int u = 0; u < pinhole_.width; ++u)
      gray[u] += mixed_[size_t(u)] ? shade_mixed(u, v) : shade_owner(centre[u], ray(u, v, 0));
  }

  Pinhole pinhole_;
  const std::vector<Eigen::Vector2f>& rays_;
  RowRange rows_;
  std::vector<ViewSurface> views_;
  ViewSurface sky_;
  bool has_clouds_ = false;
  ShadingContext context_;
  RowSamples row_;
  std::vector<int32_t> mixed_ = std::vector<int32_t>(size_t(pinhole_.width), 0);
};

}  // namespace

void add_rows_seen(const Scene& scene, const std::vector<Eigen::Vector2f>& rays, const SE3& T_scene_cam,
                   RowRange rows, std::vector<float>* gray) {
  ImagePass(scene, rays, T_scene_cam, rows).add_to(gray);
}

}  // namespace edgevo
