// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keyframes and a bootstrap with exact poses and depths in the hollow scene, for the tests of window and
// mapper.
#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/map/keyframe.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/mapping/depth_filter.h"
#include "support/hollow_scene.h"

namespace edgevo::test {

/// The hollow scene along the sweep; pyramids are built once and shared by all tests of a program.
class Sweep {
 public:
  static const HollowScene& scene() {
    static const HollowScene the_scene;
    return the_scene;
  }
  static std::shared_ptr<const FramePyramid> pyramid(int frame) {
    static std::map<int, std::shared_ptr<const FramePyramid>> made;
    auto& p = made[frame];
    if (!p) p = scene().pyramid(sweep_pose(frame), 1.0, 0.0, 1.0, uint64_t(frame + 1));
    return p;
  }
  static Pinhole pinhole() { return scene().camera.pinhole(); }
  static double idepth(int frame, const Eigen::Vector2d& px) { return scene().idepth(sweep_pose(frame), px); }
  static Timestamp time(int frame) { return Timestamp::from_seconds(0.1 * frame); }
};

/// Keyframe `id` at frame `frame` with its true pose; its immature points have the true inverse depth times
/// (1 + depth_noise * normal), a matching sigma and three good measurements.
inline Keyframe true_keyframe(int id, int frame, double depth_noise, Random* random) {
  Keyframe k;
  k.id = id;
  k.frame_index = frame;
  k.time = Sweep::time(frame);
  k.pyramid = Sweep::pyramid(frame);
  k.T_cam_world = sweep_pose(frame).inverse();
  const DepthFilterParams params;
  const CellGrid grid(Sweep::pinhole().width, Sweep::pinhole().height, params.cell_px);
  const auto range = [](const Eigen::Vector2d&) { return IdepthRange{0.1, 0.2}; };
  k.immature =
      make_immature_points(k, grid, std::vector<bool>(size_t(grid.size()), false), range, params, random);
  for (ImmaturePoint& p : k.immature) {
    const double truth = Sweep::idepth(frame, p.px);
    p.idepth = truth * (1 + depth_noise * random->normal());
    p.idepth_sigma = truth * std::max(depth_noise, 0.01);
    p.good = 3;
  }
  return k;
}

/// Frames first..last with true poses and depths, as a bootstrap would find them; `unit` is its arbitrary
/// unit of length.
inline BootstrapResult true_bootstrap(int first, int last, double unit = 1.0) {
  BootstrapResult result;
  for (int f = first; f <= last; ++f) {
    BootstrapView view;
    view.frame_index = f;
    view.time = Sweep::time(f);
    view.pyramid = Sweep::pyramid(f);
    const SE3 T = sweep_pose(f).inverse() * sweep_pose(first);
    view.T_cam_first = SE3(T.rotation(), unit * T.translation());
    view.placed = true;
    result.views.push_back(std::move(view));
  }
  const SE3 T_last_first = sweep_pose(last).inverse() * sweep_pose(first);
  for (double y = 10; y < 235; y += 15)
    for (double x = 10; x < 315; x += 15) {
      BootstrapCorner c;
      c.px_first = {x, y};
      const double q = Sweep::idepth(first, c.px_first);
      const Projection p = project(Sweep::pinhole(), T_last_first.R(), T_last_first.translation(),
                                   Sweep::pinhole().ray(c.px_first), q);
      if (!p.valid || !Sweep::pinhole().contains(p.px)) continue;
      c.px_last = p.px;
      c.idepth_first = q / unit;
      c.idepth_last = Sweep::idepth(last, p.px) / unit;
      result.corners.push_back(c);
    }
  result.parallax_deg = 2;
  return result;
}

}  // namespace edgevo::test
