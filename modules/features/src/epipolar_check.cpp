// SPDX-License-Identifier: BSD-3-Clause
#include "epipolar_check.h"

#include <algorithm>
#include <limits>

namespace edgevo {
namespace {

constexpr int kFramesApart = 8;
constexpr int kMinOld = 10;
constexpr double kMaxPx = 1.5;  // of the level that corners are followed in

// Distance of `px` from the image of all points in front of a camera that lie on its `ray`.
double distance_px(const Pinhole& pinhole, const SE3& T_cur_view, const Eigen::Vector3d& ray,
                   const Eigen::Vector2d& px) {
  const Eigen::Vector3d far = T_cur_view.rotation() * ray;
  const Eigen::Vector3d& t = T_cur_view.translation();
  if (!(far.z() > 0.05)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d start = pinhole.project(far);
  const Eigen::Vector2d off = px - start;
  Eigen::Vector2d along(pinhole.fx * (t.x() - far.x() / far.z() * t.z()),
                        pinhole.fy * (t.y() - far.y() / far.z() * t.z()));
  if (!(along.norm() > 0)) return off.norm();
  along.normalize();
  return (off - std::max(0.0, off.dot(along)) * along).norm();
}

}  // namespace

double EpipolarCheck::add(const CornerView& view, const SE3& T_cam_odometry) {
  std::vector<Seen> now;
  size_t s = 0;
  int old = 0, agreeing = 0;
  for (const CornerTrack& t : view.tracks) {
    const Eigen::Vector2d px = t.px.cast<double>();
    const View here{view.pinhole.ray(px), T_cam_odometry};
    while (s < seen_.size() && seen_[s].id < t.id) ++s;
    if (s == seen_.size() || seen_[s].id != t.id) {
      now.push_back({t.id, 0, false, {}, here});
      continue;
    }
    Seen seen = seen_[s];
    if (++seen.frames >= kFramesApart)
      seen.older = seen.newer, seen.newer = here, seen.frames = 0, seen.has_older = true;
    now.push_back(seen);
    if (!seen.has_older) continue;
    ++old;
    agreeing += distance_px(view.pinhole, T_cam_odometry * seen.older.T_cam_odometry.inverse(),
                            seen.older.ray, px) < kMaxPx;
  }
  seen_ = std::move(now);
  return old < kMinOld ? std::numeric_limits<double>::quiet_NaN() : double(agreeing) / old;
}

}  // namespace edgevo
