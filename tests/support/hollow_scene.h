// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The inside of a convex room with a solid texture, seen by a pinhole camera: exact images and exact depth
// without a renderer and, unlike a plane, no degenerate case for the essential matrix.
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/random.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/frame_pyramid.h"
#include "support/test_images.h"

namespace edgevo::test {

/// Sum of waves in space, saturating so that it gives edges and not only shading.
class SolidTexture {
  // A wave of period 1, a sine to 0.1 % by two corrected parabolas: rendering takes most of the time of many
  // tests.
  static double wave(double turns) {
    const double x = turns - double(int64_t(turns + (turns > 0 ? 0.5 : -0.5)));  // -0.5 ... 0.5
    const double y = 8 * x - 16 * x * std::abs(x);
    return y + 0.225 * (y * std::abs(y) - y);
  }

 public:
  SolidTexture(uint64_t seed, double shortest, double longest) {
    Random random(seed);
    for (Wave& w : waves_) {
      const Eigen::Vector3d direction(random.normal(), random.normal(), random.normal());
      w = {direction.normalized() / random.uniform(shortest, longest), random.uniform()};
    }
  }
  double at(const Eigen::Vector3d& p) const {
    double sum = 0;
    for (const Wave& w : waves_) sum += wave(w.k.dot(p) + w.phase);
    return 128 + 95 * std::tanh(0.6 * sum);
  }

 private:
  struct Wave {
    Eigen::Vector3d k;
    double phase;
  };
  Wave waves_[12];
};

/// World frame: the axes of a camera in the middle that looks at the far wall, 7 away; the other walls
/// are 3.5 to the left and right and 2.5 below and above, all slanted outwards.
class HollowScene {
 public:
  /// `shortest` and `longest` are the wave lengths of the texture.
  explicit HollowScene(uint64_t seed = 5, int width = 320, int height = 240, double shortest = 0.3,
                       double longest = 1.8)
      : texture_(seed, shortest, longest) {
    const double f = 0.8 * width;
    camera.set_pinhole({f, f, 0.5 * width - 0.5, 0.5 * height - 0.5, width, height});
    add_wall({0.15, -0.1, 1}, 7);
    add_wall({-1, 0, 0.45}, 3.5);
    add_wall({1, 0, 0.35}, 3.5);
    add_wall({0, 1, 0.4}, 2.5);
    add_wall({0, -1, 0.5}, 2.5);
  }

  /// Inverse depth 1/z of pixel `px` in a camera at T_world_cam: that of the nearest wall.
  double idepth(const SE3& T_world_cam, const Eigen::Vector2d& px) const {
    const Eigen::Vector3d ray = T_world_cam.R() * camera.pinhole().ray(px);
    double nearest = 0;
    for (const Wall& w : walls_)
      nearest = std::max(nearest, w.normal.dot(ray) / (w.distance - w.normal.dot(T_world_cam.translation())));
    return nearest;
  }
  /// `noise` is the standard deviation in gray levels, drawn from `noise_seed`.
  GrayImage render(const SE3& T_world_cam, double gain = 1.0, double offset = 0.0, double noise = 0.0,
                   uint64_t noise_seed = 1) const {
    Random random(noise_seed);
    const Eigen::Matrix3d R = T_world_cam.R();
    return make_image(camera.pinhole().width, camera.pinhole().height, [&](double u, double v) {
      const Eigen::Vector3d ray = camera.pinhole().ray({u, v});
      const Eigen::Vector3d p = R * ray / idepth(T_world_cam, {u, v}) + T_world_cam.translation();
      return gain * texture_.at(p) + offset + (noise > 0 ? noise * random.normal() : 0.0);
    });
  }
  /// As a rolling shutter sees it: T_world_cam(late) is the pose when a row is taken, late from -0.5 (first
  /// row) to 0.5 (last row).
  template <class PoseWhen>
  GrayImage render_rolling(const PoseWhen& T_world_cam, double noise, uint64_t noise_seed) const {
    Random random(noise_seed);
    const Pinhole& pinhole = camera.pinhole();
    std::vector<SE3> at_row;
    for (int v = 0; v < pinhole.height; ++v) at_row.push_back(T_world_cam(v / (pinhole.height - 1.0) - 0.5));
    return make_image(pinhole.width, pinhole.height, [&](double u, double v) {
      const SE3& T = at_row[size_t(v)];
      const Eigen::Vector3d p = T.R() * pinhole.ray({u, v}) / idepth(T, {u, v}) + T.translation();
      return texture_.at(p) + noise * random.normal();
    });
  }
  std::shared_ptr<const FramePyramid> pyramid(const SE3& T_world_cam, double gain = 1.0, double offset = 0.0,
                                              double noise = 0.0, uint64_t noise_seed = 1) const {
    return PyramidBuilder(camera, EdgeParams()).build(render(T_world_cam, gain, offset, noise, noise_seed));
  }

  Camera camera;

 private:
  struct Wall {
    Eigen::Vector3d normal;
    double distance;
  };
  void add_wall(const Eigen::Vector3d& normal, double distance) {
    walls_.push_back({normal.normalized(), distance});
  }

  std::vector<Wall> walls_;
  SolidTexture texture_;
};

/// Sideways with some forward motion and turning: T_world_cam of frame k, about 0.04 a frame; smooth, stays
/// in the hollow for |k| < 200.
inline SE3 sweep_pose(double k) {
  const double s = 0.02 * k;
  const Eigen::Vector3d position(1.9 * std::sin(s), 0.3 * std::sin(1.3 * s), 0.7 * (1 - std::cos(s)));
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(-0.2 * std::sin(s), Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(0.05 * std::sin(2 * s), Eigen::Vector3d::UnitX()));
  return {rotation, position};
}

}  // namespace edgevo::test
