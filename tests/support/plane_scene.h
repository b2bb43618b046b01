// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A textured, slanted plane seen by a pinhole camera: exact images and exact depth for tests, without a
// renderer.
#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/frame_pyramid.h"
#include "support/test_images.h"

namespace edgevo::test {

/// Plane n^T p = distance in the world (the first camera's frame), textured by its own x and y.
class PlaneScene {
 public:
  explicit PlaneScene(uint64_t seed = 11, Eigen::Vector3d normal = {0.25, -0.15, 1.0}, double distance = 5.0)
      : normal_(normal.normalized()), distance_(distance), texture_(seed, 0.12, 1.0) {
    camera.set_pinhole({260, 260, 159.5, 119.5, 320, 240});
  }

  /// Inverse depth 1/z of pixel `px` in a camera at T_world_cam.
  double idepth(const SE3& T_world_cam, const Eigen::Vector2d& px) const {
    const Eigen::Vector3d ray = T_world_cam.R() * camera.pinhole().ray(px);
    return normal_.dot(ray) / (distance_ - normal_.dot(T_world_cam.translation()));
  }
  GrayImage render(const SE3& T_world_cam, double gain = 1.0, double offset = 0.0) const {
    return make_image(camera.pinhole().width, camera.pinhole().height, [&](double u, double v) {
      const Eigen::Vector3d p = T_world_cam * (camera.pinhole().ray({u, v}) / idepth(T_world_cam, {u, v}));
      return gain * texture_.at(p.head<2>()) + offset;
    });
  }
  std::shared_ptr<const FramePyramid> pyramid(const SE3& T_world_cam, double gain = 1.0,
                                              double offset = 0.0) const {
    PyramidBuilder builder(camera, EdgeParams());
    return builder.build(render(T_world_cam, gain, offset));
  }
  /// Every `step`-th edge pixel of the reference with its exact depth.
  ReferenceCloud cloud(const SE3& T_world_cam, int step = 4, bool gradient_patches = false) const {
    const auto reference = pyramid(T_world_cam);
    std::vector<CloudPoint> points;
    const auto& pixels = reference->finest().edges.pixels;
    for (size_t i = 0; i < pixels.size(); i += size_t(step)) {
      const Eigen::Vector2d px = pixels[i].position().cast<double>();
      CloudPoint p;
      p.ray = camera.pinhole().ray(px);
      p.idepth = idepth(T_world_cam, px);
      p.idepth_sigma = 0.01 * p.idepth;
      p.px = pixels[i].position();
      p.normal = pixels[i].normal();
      points.push_back(p);
    }
    return make_reference_cloud(reference, points, gradient_patches);
  }

  Camera camera;

 private:
  Eigen::Vector3d normal_;
  double distance_;
  Texture texture_;
};

}  // namespace edgevo::test
