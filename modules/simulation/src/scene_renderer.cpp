#include "edgevo/simulation/scene_renderer.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/random.h"
#include "sensor_noise.h"
#include "shading.h"
#include "visibility.h"

namespace edgevo {
namespace {

// Calls `draw(surface, its number)` for the surfaces that may touch row v; rows are asked for in order. Cut-outs come last and
// from near to far: their masks are then asked only where they are not hidden.
class ActiveSurfaces {
 public:
  explicit ActiveSurfaces(const std::vector<ViewSurface>& views) : views_(views) {
    for (int i = 0; i < int(views.size()); ++i) by_row_.push_back(i);
    std::stable_sort(by_row_.begin(), by_row_.end(),
                     [&](int a, int b) { return views[size_t(a)].row_begin < views[size_t(b)].row_begin; });
  }
  template <class Draw>
  void for_row(int v, Draw draw) {
    for (; next_ < by_row_.size() && views_[size_t(by_row_[next_])].row_begin <= v; ++next_) enter(by_row_[next_]);
    for (std::vector<int>* active : {&opaque_, &cut_out_}) {
      active->erase(std::remove_if(active->begin(), active->end(), [&](int i) { return views_[size_t(i)].row_end <= v; }),
                    active->end());
      for (int i : *active) draw(views_[size_t(i)], i);
    }
  }

 private:
  void enter(int i) {
    if (!views_[size_t(i)].texture->is_cut_out()) return opaque_.push_back(i);
    const auto nearer = [&](int a, int b) { return views_[size_t(a)].distance < views_[size_t(b)].distance; };
    cut_out_.insert(std::upper_bound(cut_out_.begin(), cut_out_.end(), i, nearer), i);
  }
  const std::vector<ViewSurface>& views_;
  std::vector<int> by_row_, opaque_, cut_out_;
  size_t next_ = 0;
};

// The image, row by row: visibility of all samples, then one shading for each surface that a pixel sees.
class ImagePass {
 public:
  ImagePass(const Scene& scene, const std::vector<Eigen::Vector2f>& rays, const SE3& T_scene_cam)
      : pinhole_(scene.camera.pinhole),
        rays_(rays),
        views_(view_surfaces(*scene.world, scene.camera, T_scene_cam)),
        row_(pinhole_.width, kSamples) {
    context_ = {float(1 / pinhole_.fx), float(1 / pinhole_.fy), scene.world->sky.gray, float(scene.world->sky.haze_per_metre)};
    has_clouds_ = scene.world->sky.texture >= 0;
    if (has_clouds_) sky_ = view_sky(*scene.world, T_scene_cam);
    set_sample_columns(pinhole_, kSamples, &row_);
  }

  std::vector<float> run() {
    std::vector<float> gray(size_t(pinhole_.width) * pinhole_.height);
    ActiveSurfaces active(views_);
    for (int v = 0; v < pinhole_.height; ++v) {
      row_.clear();
      active.for_row(v, [&](const ViewSurface& view, int id) { draw(view, id, v); });
      shade_row(v, gray.data() + size_t(v) * pinhole_.width);
    }
    return gray;
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
  void shade_row(int v, float* gray) {
    std::fill(mixed_.begin(), mixed_.end(), 0);
    const int32_t* centre = row_.owner_of(0);
    for (int s = 1; s < kSamples; ++s) {
      const int32_t* other = row_.owner_of(s);
      for (int u = 0; u < pinhole_.width; ++u) mixed_[size_t(u)] |= centre[u] ^ other[u];
    }
    for (int u = 0; u < pinhole_.width; ++u)
      gray[u] = mixed_[size_t(u)] ? shade_mixed(u, v) : shade_owner(centre[u], ray(u, v, 0));
  }

  Pinhole pinhole_;
  const std::vector<Eigen::Vector2f>& rays_;
  std::vector<ViewSurface> views_;
  ViewSurface sky_;
  bool has_clouds_ = false;
  ShadingContext context_;
  RowSamples row_;
  std::vector<int32_t> mixed_ = std::vector<int32_t>(size_t(pinhole_.width), 0);
};

std::vector<Eigen::Vector2f> rays_through_lens(const Camera& camera) {
  const Pinhole& p = camera.pinhole;
  if (camera.distortion.is_zero()) return {};
  std::vector<Eigen::Vector2f> rays;
  rays.reserve(size_t(p.width) * p.height * kSamples);
  for (int v = 0; v < p.height; ++v)
    for (const Eigen::Vector2f& offset : sample_offsets())
      for (int u = 0; u < p.width; ++u) {
        const Eigen::Vector2d distorted = p.ray(Eigen::Vector2d(u, v) + offset.cast<double>()).head<2>();
        Eigen::Vector2d x = distorted;
        if (!camera.undistort(distorted, &x)) x = distorted;  // beyond the model: a corner that no ray reaches
        rays.push_back(x.cast<float>());
      }
  return rays;
}

}  // namespace

SceneRenderer::SceneRenderer(Scene scene) : scene_(std::move(scene)), rays_(rays_through_lens(scene_.camera)) {}

SE3 SceneRenderer::T_world_cam(int index) const {
  return scene_.T_scene_cam.front().inverse() * scene_.T_scene_cam[size_t(index)];
}

GrayImage SceneRenderer::render_image(int index) const {
  const std::vector<float> gray = ImagePass(scene_, rays_, scene_.T_scene_cam[size_t(index)]).run();
  const Pinhole& p = scene_.camera.pinhole;
  return {p.width, p.height, with_sensor_noise(gray, scene_.noise_sigma, scene_.seed, index)};
}

std::vector<float> SceneRenderer::render_depth(int index) const {
  Camera ideal = scene_.camera;
  ideal.distortion = {};
  const Pinhole& p = ideal.pinhole;
  const std::vector<ViewSurface> views = view_surfaces(*scene_.world, ideal, scene_.T_scene_cam[size_t(index)]);
  RowSamples row(p.width, 1);
  set_sample_columns(p, 1, &row);
  ActiveSurfaces active(views);
  std::vector<float> depth;
  depth.reserve(size_t(p.width) * p.height);
  for (int v = 0; v < p.height; ++v) {
    row.clear();
    active.for_row(v, [&](const ViewSurface& view, int id) { draw_pinhole(view, id, p, v, 0, &row); });
    for (int u = 0; u < p.width; ++u) {
      const int owner = row.owner_of(0)[u];
      const double idepth = owner < 0 ? 0 : views[size_t(owner)].idepth.dot(p.ray({double(u), double(v)}));
      depth.push_back(owner < 0 ? 0.0f : float(1 / idepth));
    }
  }
  return depth;
}

RenderedFrame SceneRenderer::render(int index) const {
  return {index, scene_.times[size_t(index)], render_image(index), render_depth(index), T_world_cam(index)};
}

}  // namespace edgevo
