// SPDX-License-Identifier: BSD-3-Clause
#include "road.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kStep = 0.02;   // seconds between points of the path
constexpr double kReach = 1.5;   // metres on each side, over which a direction is taken
constexpr double kTurning = 25;  // metres
constexpr double kRamp = 2;      // seconds in which the camera slows down

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Time of the scene without the stop.
double unstopped(double t, double at, double seconds) {
  double since = t - (at - kRamp / 2);
  if (since <= 0) return t;
  if (since < kRamp) return at - kRamp / 2 + since - since * since / (2 * kRamp);
  since -= kRamp + seconds;
  if (since <= 0) return at;
  if (since < kRamp) return at + since * since / (2 * kRamp);
  return at + since - kRamp / 2;
}

}  // namespace

Road::Road(const Scene& scene) : step_s_(kStep), gone_{0} {
  const double end = scene.times.back().seconds();
  for (double t = 0; t <= end; t += kStep) points_.push_back(scene.T_scene_cam_at(t).translation().head<2>());
  for (size_t i = 1; i < points_.size(); ++i)
    gone_.push_back(gone_.back() + (points_[i] - points_[i - 1]).norm());
}

double Road::gone(double seconds) const {
  const double at = std::clamp(seconds / step_s_, 0.0, double(gone_.size() - 1));
  const size_t i = std::min(size_t(at), gone_.size() - 2);
  return gone_[i] + (at - double(i)) * (gone_[i + 1] - gone_[i]);
}

Eigen::Vector2d Road::point(double s) const {
  if (s < 0) return points_.front() + s * direction(0);
  if (s > length()) return points_.back() + (s - length()) * direction(length());
  const size_t next = size_t(std::upper_bound(gone_.begin(), gone_.end(), s) - gone_.begin());
  const size_t i = std::min(next, gone_.size() - 1);
  const double step = gone_[i] - gone_[i - 1];
  return step > 0 ? points_[i - 1] + (s - gone_[i - 1]) / step * (points_[i] - points_[i - 1]) : points_[i];
}

Eigen::Vector2d Road::direction(double s) const {
  const double low = std::clamp(s - kReach, 0.0, length() - kReach),
               high = std::clamp(s + kReach, kReach, length());
  return (point(high) - point(low)).normalized();
}

SE3 Road::at(double s, double left) const {
  const Eigen::Vector2d forward = direction(s);
  return on_ground(point(s) + left * Eigen::Vector2d(-forward.y(), forward.x()), forward);
}

std::vector<Turning> Road::turnings() const {
  std::vector<Turning> found;
  for (double s = kReach; s + kTurning < length(); s += 0.5) {
    const Eigen::Vector2d before = direction(s), after = direction(s + kTurning);
    if (before.dot(after) > std::sqrt(0.5) || before.dot(direction(s + 1)) > 0.9997) continue;
    const Eigen::Vector2d p = point(s);
    const double ahead = cross(point(s + kTurning) - p, after) / cross(before, after);
    const size_t i = size_t(std::lower_bound(gone_.begin(), gone_.end(), s) - gone_.begin());
    found.push_back({p + ahead * before, after, double(i) * step_s_});
    s += kTurning;
  }
  return found;
}

SE3 on_ground(const Eigen::Vector2d& p, const Eigen::Vector2d& forward) {
  Eigen::Matrix3d R;
  R.col(0) << forward, 0;
  R.col(1) << -forward.y(), forward.x(), 0;
  R.col(2) = Eigen::Vector3d::UnitZ();
  return {R, Eigen::Vector3d(p.x(), p.y(), 0)};
}

void stop_camera(double at, double seconds, Scene* scene) {
  const double end = scene->times.back().seconds(), step = end / (scene->size() - 1);
  const auto original = scene->T_scene_cam_at;
  const auto stopped = [=](double t) { return original(unstopped(t, at, seconds)); };
  scene->T_scene_cam.clear();
  scene->times.clear();
  for (int i = 0; unstopped(i * step, at, seconds) <= end + 1e-9; ++i) {
    scene->T_scene_cam.push_back(stopped(i * step));
    scene->times.push_back(Timestamp::from_seconds(i * step));
  }
  scene->T_scene_cam_at = stopped;
}

}  // namespace edgevo
