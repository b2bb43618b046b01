// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Corners as they are followed along a street of points, with known noise and without images.
#include <cmath>
#include <random>
#include <vector>

#include "corner_tracks.h"

namespace edgevo::test {

inline const Pinhole& street_camera() {
  static const Pinhole camera{360, 360, 310, 94, 621, 188};
  return camera;
}

/// The points, and which of them are followed.
class CornerStreet {
 public:
  /// `noise_px`: standard deviation of a corner in each direction.
  explicit CornerStreet(double moving_share = 0, unsigned seed = 5, double noise_px = 0.2)
      : random_(seed), noise_px_(noise_px) {
    for (int i = 0; i < kPoints; ++i) {
      points_.emplace_back(at(-14, 14), at(-4, 1.6), at(0, 260));
      if (std::abs(points_.back().x()) < 2.5) points_.back().y() = 1.6;
      moves_.push_back(at(0, 1) < moving_share);
    }
  }
  /// The corners that the camera sees: those followed so far as long as they are in view, and new ones.
  CornerView look(const SE3& T_cam_world, int frame) {
    CornerView view{street_camera(), {}};
    std::vector<size_t> followed;
    const auto see = [&](size_t i) {
      Eigen::Vector3d p = points_[i];
      if (moves_[i]) p += frame * Eigen::Vector3d(0.02, 0, 0.5);
      const Eigen::Vector3d c = T_cam_world * p;
      if (c.z() < 2 || c.z() > 60) return;
      const Eigen::Vector2d px =
          street_camera().project(c) + noise_px_ * Eigen::Vector2d(normal_(random_), normal_(random_));
      if (!street_camera().contains(px, 4)) return;
      if (ids_[i] == 0) ids_[i] = next_id_++;
      followed.push_back(i);
      view.tracks.push_back({ids_[i], px.cast<float>(), Eigen::Vector2f::Zero()});
    };
    for (const size_t i : followed_) see(i);
    for (size_t i = 0; i < points_.size() && followed.size() < 80; ++i)
      if (ids_[i] == 0) see(i);
    followed_ = followed;
    return view;
  }

 private:
  static constexpr int kPoints = 10000;
  double at(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  std::mt19937 random_;
  double noise_px_;
  std::normal_distribution<double> normal_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<bool> moves_;
  std::vector<uint32_t> ids_ = std::vector<uint32_t>(kPoints, 0);
  std::vector<size_t> followed_;
  uint32_t next_id_ = 1;
};

/// True motion from one image to the next: gentle bends.
inline SE3 street_drive(int frame) {
  Vector6d xi;
  xi << 0, 0, -0.7, 0, 0.004 * std::sin(frame / 15.0), 0;
  return SE3::exp(xi);
}

}  // namespace edgevo::test
