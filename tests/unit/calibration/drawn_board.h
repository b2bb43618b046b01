// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images of a flat board through a known lens: nine rays a pixel into an interpolated texture. Without
// interpolation an edge would move by thirds of a pixel, and the corners with it.
#include <opencv2/core.hpp>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/random.h"
#include "edgevo/core/se3.h"

namespace edgevo::test {

/// Camera of 480 x 360 pixels whose lens shifts the image corners by 10 px.
inline Camera known_camera() {
  Camera camera;
  camera.set_pinhole({402, 398, 246, 175, 480, 360});
  camera.set_distortion({-0.21, 0.06, 0.001, -0.0005, 0});
  return camera;
}

/// A board from (0, 0) to the size of its texture, from above: x right, y down, z away from the viewer.
class DrawnBoard {
 public:
  DrawnBoard(const Camera& camera, cv::Mat texture, double px_per_m)
      : camera_(camera), texture_(std::move(texture)), px_per_m_(px_per_m) {
    for (int y = 0; y < kSub * camera.pinhole().height; ++y)
      for (int x = 0; x < kSub * camera.pinhole().width; ++x) rays_.push_back(ray({sub(x), sub(y)}));
  }

  Eigen::Vector3d centre() const {
    return {0.5 * texture_.cols / px_per_m_, 0.5 * texture_.rows / px_per_m_, 0};
  }

  /// Image with a little sensor noise.
  GrayImage seen_from(const SE3& T_cam_board) const {
    const SE3 T_board_cam = T_cam_board.inverse();
    const Pinhole p = camera_.pinhole();
    std::vector<float> sums(size_t(p.width) * size_t(p.height));
    for (size_t i = 0; i < rays_.size(); ++i) {
      const size_t columns = size_t(kSub * p.width), x = i % columns / kSub, y = i / columns / kSub;
      sums[y * size_t(p.width) + x] += brightness(T_board_cam, rays_[i]);
    }
    Random random(7);
    GrayImage image{p.width, p.height, {}};
    for (const float sum : sums)
      image.pixels.push_back(cv::saturate_cast<uint8_t>(sum / float(kSub * kSub) + float(random.normal())));
    return image;
  }

 private:
  static constexpr int kSub = 3;
  static double sub(int i) { return (i + 0.5) / kSub - 0.5; }
  Eigen::Vector3d ray(const Eigen::Vector2d& px) const {
    return camera_.unproject(px).value_or(Eigen::Vector3d(1e3, 1e3, 1));  // outside the board
  }
  float brightness(const SE3& T_board_cam, const Eigen::Vector3d& ray) const {
    const Eigen::Vector3d from = T_board_cam.translation(), along = T_board_cam.rotation() * ray;
    const Eigen::Vector3d at = px_per_m_ * (from - along * (from.z() / along.z()));
    const double left = std::floor(at.x() - 0.5), top = std::floor(at.y() - 0.5);
    const float u = float(at.x() - 0.5 - left), v = float(at.y() - 0.5 - top);
    const int x = int(left), y = int(top);
    return (1 - v) * ((1 - u) * texel(x, y) + u * texel(x + 1, y)) +
           v * ((1 - u) * texel(x, y + 1) + u * texel(x + 1, y + 1));
  }
  float texel(int x, int y) const {
    constexpr float kAround = 110;
    const bool inside = x >= 0 && y >= 0 && x < texture_.cols && y < texture_.rows;
    return inside ? float(texture_.at<uint8_t>(y, x)) : kAround;
  }

  Camera camera_;
  cv::Mat texture_;
  double px_per_m_;
  std::vector<Eigen::Vector3d> rays_;
};

/// Pose of a board turned and tipped by these angles (degrees) around `centre`, a point of the board at
/// `centre_cam`.
inline SE3 board_pose(const Eigen::Vector3d& centre, double turn, double tip,
                      const Eigen::Vector3d& centre_cam) {
  const double deg = M_PI / 180;
  const Eigen::Quaterniond R = Eigen::AngleAxisd(turn * deg, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(tip * deg, Eigen::Vector3d::UnitX());
  return SE3(R, centre_cam - R * centre);
}

}  // namespace edgevo::test
