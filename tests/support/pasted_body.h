// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A body pasted over an image: a square of blocks in different grays, wherever a test wants it.
#include <algorithm>
#include <cmath>
#include <memory>

#include "edgevo/edges/frame_pyramid.h"
#include "support/plane_scene.h"

namespace edgevo::test {

/// Place of the body, pixels: left upper corner and width.
struct BodyPlace {
  double left, top, width;
};

/// Pastes the body, ten blocks wide and high, antialiased.
inline void paste_body(const BodyPlace& at, GrayImage* image) {
  const auto gray = [](int column, int row) {
    return double((column * 73 + row * 151 + column * row * 37) % 7) * 36;
  };
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x) {
      double sum = 0;
      for (int k = 0; k < 16; ++k) {
        const double u = 10 * (x + (k % 4 - 1.5) / 4 - at.left) / at.width;
        const double v = 10 * (y + (k / 4 - 1.5) / 4 - at.top) / at.width;
        const bool is_body = u >= 0 && v >= 0 && u < 10 && v < 10;
        sum += is_body ? gray(int(u), int(v)) : image->pixels[size_t(y) * image->width + x];
      }
      image->pixels[size_t(y) * image->width + x] = uint8_t(std::lround(sum / 16));
    }
}

/// A plane with the body in front of it.
struct SceneWithBody {
  PlaneScene scene;

  std::shared_ptr<const FramePyramid> pyramid(const SE3& T_world_cam, const BodyPlace& body) const {
    GrayImage image = scene.render(T_world_cam);
    paste_body(body, &image);
    return PyramidBuilder(scene.camera, EdgeParams()).build(image);
  }
  /// Every third edge pixel as a point of keyframe 0, those of the body at the depth of the plane: what a map
  /// holds of a body that has stood still so far.
  ReferenceCloud cloud(const SE3& T_world_cam, const BodyPlace& body) const {
    const auto reference = pyramid(T_world_cam, body);
    std::vector<CloudPoint> points;
    const auto& pixels = reference->finest().edges.pixels;
    for (size_t i = 0; i < pixels.size(); i += 3) {
      CloudPoint p;
      p.px = pixels[i].position();
      p.ray = scene.camera.pinhole().ray(p.px.cast<double>());
      p.idepth = scene.idepth(T_world_cam, p.px.cast<double>());
      p.idepth_sigma = 0.01 * p.idepth;
      p.normal = pixels[i].normal();
      p.host_keyframe = 0;
      p.host_pixel = int(i);
      points.push_back(p);
    }
    return make_reference_cloud(reference, points, false);
  }
};

}  // namespace edgevo::test
