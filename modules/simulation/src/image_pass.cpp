// SPDX-License-Identifier: BSD-3-Clause
#include "image_pass.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "active_surfaces.h"
#include "shading.h"
#include "visibility.h"

namespace edgevo {
namespace {

// The image, row by row: visibility of all samples, then one shading for each surface that a pixel sees.
class ImagePass {
 public:
  ImagePass(const Scene& scene, const LensRays& rays, const Instant& at, RowRange rows)
      : pinhole_(scene.camera.pinhole()), rays_(rays), rows_(rows), row_(pinhole_.width, kSamples) {
    context_ = {float(1 / pinhole_.fx), float(1 / pinhole_.fy), scene.world->sky.gray,
                float(scene.world->sky.haze_per_metre)};
    if (scene.light_change) set_light(*scene.light_change, at);
    has_clouds_ = scene.world->sky.texture >= 0;
    if (rays.has_faces()) {
      add_faces(scene, at);
    } else {
      add_views(view_scene(scene, scene.camera, at, rows));
      if (has_clouds_) sky_[0] = view_sky(*scene.world, at.T_scene_cam);
    }
    set_sample_columns(pinhole_, kSamples, &row_);
  }

  // Adds to `gray`, the whole image row by row.
  void add_to(std::vector<float>* gray) {
    for_rows([&](int v) { add_row(v, gray->data() + size_t(v) * pinhole_.width); });
  }

  // Sets `bodies`, the whole image row by row.
  void set_bodies(std::vector<uint8_t>* bodies) {
    for_rows([&](int v) { set_row_of_bodies(bodies->data() + size_t(v) * pinhole_.width); });
  }

 private:
  void set_light(const LightChange& change, const Instant& at) {
    const float share = float(change.share(at.seconds));
    const auto mix = [&](float a, float b) { return (1 - share) * a + share * b; };
    const Light &first = change.first, &second = change.second;
    context_.haze_gray = mix(first.sky_gray, second.sky_gray);
    context_.haze_per_metre = mix(first.haze_per_metre, second.haze_per_metre);
    context_.exposure = mix(first.exposure, second.exposure);
    context_.shadows[0] = first.shadow.get(), context_.shadows[1] = second.shadow.get();
    context_.weights[0] = 1 - share, context_.weights[1] = share;
    context_.eye = at.T_scene_cam.translation().head<2>().cast<float>();
  }

  // Calls `take` for each row, once it is known what its samples meet.
  template <class Take>
  void for_rows(const Take& take) {
    ActiveSurfaces active(views_);
    for (int v = rows_.begin; v < rows_.end; ++v) {
      row_.clear();
      if (rays_.has_faces()) begin_row(v);
      active.for_row(v, [&](const ViewSurface& view, int id) { draw(view, id, v); });
      take(v);
    }
  }
  // Owner of a sample that sees the sky through a face, or that no ray reaches.
  static int sky_owner(uint8_t face) { return -1 - int(face); }
  static constexpr int kNoOwner = -1 - int(kNoFace);

  void add_views(const SceneViews& views) {
    views_.insert(views_.end(), views.surfaces.begin(), views.surfaces.end());
    body_.insert(body_.end(), views.body.begin(), views.body.end());
  }

  // The views of all faces through which some ray points, one after the other.
  void add_faces(const Scene& scene, const Instant& at) {
    for (int face = 0; face < kFaces; ++face) {
      if (std::find(rays_.face.begin(), rays_.face.end(), uint8_t(face)) == rays_.face.end()) continue;
      add_views(view_scene_in_face(scene, scene.camera, face, at, rows_));
      face_of_view_.resize(views_.size(), face);
      if (has_clouds_) sky_[size_t(face)] = view_sky(*scene.world, T_scene_face(at.T_scene_cam, face));
      rays_in_face_[size_t(face)].resize(size_t(kSamples) * size_t(pinhole_.width));
    }
  }
  // The rays of this row by face, those of the others NaN; each sample first sees the sky of its face.
  void begin_row(int v) {
    const Eigen::Vector2f nothing = Eigen::Vector2f::Constant(NAN);
    const size_t count = size_t(kSamples) * size_t(pinhole_.width), first = size_t(v) * count;
    for (int face = 0; face < kFaces; ++face) {
      std::vector<Eigen::Vector2f>& here = rays_in_face_[size_t(face)];
      for (size_t i = 0; i < here.size(); ++i)
        here[i] = rays_.face[first + i] == face ? rays_.xy[first + i] : nothing;
    }
    for (size_t i = 0; i < count; ++i) row_.owner[i] = sky_owner(rays_.face[first + i]);
  }
  void draw(const ViewSurface& view, int id, int v) {
    for (int s = 0; s < kSamples; ++s)
      if (rays_.xy.empty())
        draw_pinhole(view, id, pinhole_, v, s, &row_);
      else if (rays_.has_faces())
        draw_along_rays(view, id, row_in_face(face_of_view_[size_t(id)], s), s, &row_);
      else
        draw_along_rays(view, id, rays_of(v, s), s, &row_);
  }
  const Eigen::Vector2f* row_in_face(int face, int s) const {
    return rays_in_face_[size_t(face)].data() + size_t(s) * size_t(pinhole_.width);
  }
  size_t index_of(int v, int s) const { return (size_t(v) * kSamples + size_t(s)) * size_t(pinhole_.width); }
  const Eigen::Vector2f* rays_of(int v, int s) const { return rays_.xy.data() + index_of(v, s); }
  Eigen::Vector2f ray(int u, int v, int s) const {
    if (!rays_.xy.empty()) return rays_of(v, s)[u];
    return {row_.x[size_t(s) * size_t(pinhole_.width) + size_t(u)],
            (float(v) + sample_offsets()[size_t(s)].y() - float(pinhole_.cy)) / float(pinhole_.fy)};
  }
  // Length of the step from the ray of a pixel to that of the next one, or of the one before at a seam.
  float step(int u, int v, int du, int dv) const {
    const auto face = [&](int x, int y) {
      const bool is_inside = x >= 0 && y >= 0 && x < pinhole_.width && y < pinhole_.height;
      return is_inside ? rays_.face[index_of(y, 0) + size_t(x)] : kNoFace;
    };
    const Eigen::Vector2f here = ray(u, v, 0);
    for (const int sign : {1, -1})
      if (const int x = u + sign * du, y = v + sign * dv; face(x, y) == face(u, v) && face(u, v) != kNoFace)
        return (ray(x, y, 0) - here).norm();
    return du ? context_.pixel_x : context_.pixel_y;
  }
  // A lens that looks through faces differs in the size of its pixels.
  ShadingContext context_at(int u, int v) const {
    ShadingContext context = context_;
    if (rays_.has_faces()) context.pixel_x = step(u, v, 1, 0), context.pixel_y = step(u, v, 0, 1);
    return context;
  }
  float shade_owner(int owner, const ShadingContext& context, const Eigen::Vector2f& x) const {
    if (owner >= 0) return shade(views_[size_t(owner)], context, x.x(), x.y());
    if (owner == kNoOwner) return 0;
    const ViewSurface& sky = sky_[size_t(-1 - owner)];
    return has_clouds_ ? shade_sky(sky, context, x.x(), x.y()) : context.haze_gray;
  }
  // A pixel that sees several surfaces: each is shaded at the mean of its samples and counts by their number.
  float shade_mixed(int u, int v) {
    const ShadingContext context = context_at(u, v);
    bool done[kSamples] = {};
    float sum = 0;
    for (int s = 0; s < kSamples; ++s) {
      if (done[s]) continue;
      const int owner = row_.owner_of(s)[u];
      Eigen::Vector2f mean = Eigen::Vector2f::Zero();
      int count = 0;
      for (int t = s; t < kSamples; ++t)
        if (row_.owner_of(t)[u] == owner) mean += ray(u, v, t), ++count, done[t] = true;
      sum += float(count) * shade_owner(owner, context, mean / float(count));
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
      gray[u] +=
          mixed_[size_t(u)] ? shade_mixed(u, v) : shade_owner(centre[u], context_at(u, v), ray(u, v, 0));
  }

  void set_row_of_bodies(uint8_t* bodies) {
    constexpr int kMax = 99;
    std::fill(bodies, bodies + pinhole_.width, kSceneAlone);
    for (int s = 0; s < kSamples; ++s) {
      const int32_t* owner = row_.owner_of(s);
      for (int u = 0; u < pinhole_.width; ++u)
        if (owner[u] >= 0 && body_[size_t(owner[u])] != kNoBody)
          bodies[u] = std::min(bodies[u], uint8_t(std::min(body_[size_t(owner[u])], kMax)));
    }
  }

  Pinhole pinhole_;
  const LensRays& rays_;
  RowRange rows_;
  std::vector<ViewSurface> views_;
  std::vector<int> body_;  // of each view
  std::vector<int> face_of_view_;
  std::array<std::vector<Eigen::Vector2f>, kFaces> rays_in_face_;  // of the current row
  std::array<ViewSurface, kFaces> sky_;
  bool has_clouds_ = false;
  ShadingContext context_;
  RowSamples row_;
  std::vector<int32_t> mixed_ = std::vector<int32_t>(size_t(pinhole_.width), 0);
};

}  // namespace

void add_rows_seen(const Scene& scene, const LensRays& rays, const Instant& at, RowRange rows,
                   std::vector<float>* gray) {
  ImagePass(scene, rays, at, rows).add_to(gray);
}

void set_rows_of_bodies(const Scene& scene, const LensRays& rays, const Instant& at, RowRange rows,
                        std::vector<uint8_t>* bodies) {
  ImagePass(scene, rays, at, rows).set_bodies(bodies);
}

}  // namespace edgevo
