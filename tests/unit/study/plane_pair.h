// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two views of a textured plane with exact depth, as the study makes them.
#include "edgevo/study/study_pair.h"
#include "support/plane_scene.h"

namespace edgevo::test {

class PlanePair {
 public:
  explicit PlanePair(int points = 300, double noise = 0.02, double gain = 1, double offset = 0) {
    Vector6d xi;
    xi << 0.12, 0.03, 0.10, 0.006, -0.010, 0.004;
    T_world_target = SE3::exp(xi);
    depth_host = depth_of(SE3());
    depth_target = depth_of(T_world_target);
    auto pyramid = scene.pyramid(SE3());
    Random random(3);
    auto sampled = sample_points(pyramid->finest().edges, view(depth_host), points, noise, &random);
    host = make_host(std::move(pyramid), std::move(sampled));
    const SE3 T_target_host = T_world_target.inverse();
    const ViewPair views{scene.camera.pinhole(), view(depth_host), view(depth_target), T_target_host};
    target = make_target(host, scene.pyramid(T_world_target, gain, offset), views, T_target_host);
  }

  Pinhole camera() const { return scene.camera.pinhole(); }

  PlaneScene scene;
  SE3 T_world_target;
  std::vector<float> depth_host, depth_target;
  HostView host;
  TargetView target;

 private:
  ImageView<float> view(const std::vector<float>& depth) const {
    return {depth.data(), scene.camera.pinhole().width, scene.camera.pinhole().height,
            scene.camera.pinhole().width};
  }
  std::vector<float> depth_of(const SE3& T_world_cam) const {
    const Pinhole p = scene.camera.pinhole();
    std::vector<float> depth;
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x)
        depth.push_back(float(1 / scene.idepth(T_world_cam, {double(x), double(y)})));
    return depth;
  }
};

}  // namespace edgevo::test
