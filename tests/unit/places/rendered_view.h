// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Views of rendered scenes with maps of exact depth, in a unit of their own.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/random.h"
#include "edgevo/core/records.h"
#include "edgevo/core/rectification.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/places/place_match.h"
#include "edgevo/simulation/correspondence.h"
#include "edgevo/simulation/relight.h"
#include "edgevo/simulation/scene.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo::test {

/// A view with the points of its map.
struct RenderedView {
  RememberedView view;
  std::vector<CloudPoint> points;
  SE3 T_world_cam;

  PlaceView place() const { return {view, points}; }
};

/// Views of one scene.
class ViewRenderer {
 public:
  ViewRenderer(const std::string& scene, uint64_t seed) : renderer_(load_scene(scene, seed)) {}

  Pinhole pinhole() const { return renderer_.undistorted(); }

  SE3 T_world_cam(int frame) const { return renderer_.T_world_cam(frame); }
  std::shared_ptr<const FramePyramid> pyramid(int frame) const {
    PyramidBuilder builder(Rectification(renderer_.camera()), EdgeParams());
    return builder.build(renderer_.render_image(frame));
  }
  /// Edge points with depths in metres, as many as a keyframe hosts.
  std::vector<EdgePoint> edge_points(const FramePyramid& pyramid, int frame) const {
    RenderedFrame rendered;
    rendered.depth = renderer_.render_depth(frame);
    std::vector<EdgePoint> points;
    const std::vector<CloudPoint> all = points_of(pyramid, rendered, 1, uint64_t(frame));
    for (size_t i = size_t(frame) % 8; i < all.size(); i += 8) {
      const CloudPoint& p = all[i];
      EdgePoint point;
      point.px = p.px, point.normal = p.normal;
      point.idepth = float(p.idepth), point.idepth_sigma = float(p.idepth_sigma);
      point.observations = 5;
      points.push_back(point);
    }
    return points;
  }

  /// A frame under changed light ("": as rendered). Lengths of its map are `unit` times those in metres, its
  /// depths off by 2 %.
  RenderedView view(int frame, double unit = 1, const std::string& light = "",
                    bool is_mirrored = false) const {
    RenderedFrame rendered = renderer_.render(frame);
    if (!light.empty()) rendered.image = Relight(light, 7).apply(rendered.image, frame, 0.1 * frame);
    if (is_mirrored) mirror(&rendered);
    PyramidBuilder builder(Rectification(renderer_.camera()), EdgeParams());
    const auto pyramid = builder.build(rendered.image);
    return {remember_view(*pyramid), points_of(*pyramid, rendered, unit, uint64_t(frame)),
            rendered.T_world_cam};
  }

 private:
  static void mirror(RenderedFrame* frame) {
    const int width = frame->image.width, height = frame->image.height;
    GrayImage image = frame->image;
    std::vector<float> depth = frame->depth;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        image.pixels[size_t(y * width + x)] = frame->image.pixels[size_t(y * width + width - 1 - x)];
        depth[size_t(y * width + x)] = frame->depth[size_t(y * width + width - 1 - x)];
      }
    frame->image = image;
    frame->depth = depth;
  }

  std::vector<CloudPoint> points_of(const FramePyramid& pyramid, const RenderedFrame& frame, double unit,
                                    uint64_t seed) const {
    constexpr double kSigma = 0.02;
    const Pinhole camera = pinhole();
    const ImageView<float> depth{frame.depth.data(), camera.width, camera.height, camera.width};
    Random random(seed);
    std::vector<CloudPoint> points;
    const std::vector<EdgePixel>& edges = pyramid.finest().edges.pixels;
    for (size_t i = 0; i < edges.size(); i += 1 + edges.size() / 1500) {
      const double idepth = edge_idepth(depth, edges[i].position().cast<double>());
      if (!(idepth > 0)) continue;
      CloudPoint p;
      p.px = edges[i].position(), p.normal = edges[i].normal();
      p.ray = camera.ray(p.px.cast<double>());
      p.idepth = idepth / unit * (1 + kSigma * random.normal());
      p.idepth_sigma = kSigma * p.idepth;
      p.host_keyframe = 0;
      points.push_back(p);
    }
    return points;
  }

  SceneRenderer renderer_;
};

/// A street.
inline const ViewRenderer& street() {
  static const ViewRenderer renderer("street", 4);
  return renderer;
}

}  // namespace edgevo::test
