// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images of KITTI's size with about 20k edge pixels, for the benchmarks.
#include <map>
#include <memory>
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "support/hollow_scene.h"

namespace edgevo::test {

inline const test::HollowScene& scene() {
  static const test::HollowScene the_scene(5, 1241, 376, 0.1, 0.6);
  return the_scene;
}
inline Pinhole pinhole() { return scene().camera.pinhole(); }

/// Frame `k` of the sweep with sensor noise, rendered once.
inline const GrayImage& image(int k) {
  static std::map<int, GrayImage> made;
  GrayImage& g = made[k];
  if (g.empty()) g = scene().render(test::sweep_pose(k), 1, 0, 1.5, uint64_t(k + 1));
  return g;
}
inline std::shared_ptr<const FramePyramid> pyramid(int k) {
  static std::map<int, std::shared_ptr<const FramePyramid>> made;
  auto& p = made[k];
  if (!p) p = PyramidBuilder(scene().camera, EdgeParams()).build(image(k));
  return p;
}
inline SE3 motion(int from, int to) { return test::sweep_pose(to).inverse() * test::sweep_pose(from); }

/// `n` edge pixels of frame `k`, spread evenly, with exact depth.
inline std::vector<CloudPoint> points(int k, int n) {
  const auto& pixels = pyramid(k)->finest().edges.pixels;
  std::vector<CloudPoint> out;
  for (int i = 0; i < n; ++i) {
    const EdgePixel& e = pixels[size_t(i) * pixels.size() / size_t(n)];
    const Eigen::Vector2d px = e.position().cast<double>();
    const double idepth = scene().idepth(test::sweep_pose(k), px);
    out.push_back({pinhole().ray(px), idepth, 0.02 * idepth, e.position(), e.normal()});
  }
  return out;
}

}  // namespace edgevo::test
