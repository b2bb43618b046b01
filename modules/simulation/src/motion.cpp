// SPDX-License-Identifier: BSD-3-Clause
#include "motion.h"

#include <algorithm>
#include <cmath>

#include "drive_path.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"
#include "smooth_noise.h"

namespace edgevo {
namespace {
constexpr uint64_t kMotionPurpose = 0x6d6f74696f6e;

// Time of a step. At a frame it is the frame's own, to the last bit.
double seconds_at(size_t step, double rate_hz) {
  return (double(step / kStepsPerFrame) + double(step % kStepsPerFrame) / kStepsPerFrame) / rate_hz;
}

// Distance of `t` from the nearest even multiple of `leg`, rounded over `reversal` about each turning point:
// the time at which a drive that goes to and fro is where a single one would be.
double to_and_fro(double t, double leg, double reversal) {
  const double in_round = t - 2 * leg * std::floor(t / (2 * leg));
  const double from_end = std::abs(in_round - leg);                  // at the far end: 0
  const double from_start = std::min(in_round, 2 * leg - in_round);  // at the start: 0
  const auto rounded = [&](double x) { return x * x / reversal + reversal / 4; };
  if (from_end < reversal / 2) return leg - rounded(from_end);
  if (from_start < reversal / 2 && t > leg) return rounded(from_start);
  return from_start;
}

PathPoint between(const std::vector<PathPoint>& path, double step) {
  const size_t i = size_t(std::clamp(std::floor(step), 0.0, double(path.size() - 2)));
  const double t = step - double(i);
  const PathPoint &a = path[i], &b = path[i + 1];
  const double turn = std::remainder(b.yaw - a.yaw, rad(360));
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.yaw + t * turn};
}

// The path of all legs: the first one, forwards and backwards.
std::vector<PathPoint> drive_legs(const SceneParams& params, const std::string& where) {
  SceneParams one = params;
  one.frames = (params.frames + params.motion.legs - 1) / params.motion.legs;
  const std::vector<PathPoint> path = drive_along(one, kStepsPerFrame, where);
  const double leg = double(path.size() - 1),
               reversal = params.motion.reversal_s * params.rate_hz * kStepsPerFrame;
  std::vector<PathPoint> all;
  for (size_t i = 0; i < size_t(params.frames) * kStepsPerFrame; ++i)
    all.push_back(between(path, to_and_fro(double(i), leg, std::min(reversal, leg))));
  return all;
}

std::vector<SE3> drive(const SceneParams& params, Random random, const std::string& where) {
  const MotionParams& m = params.motion;
  const std::vector<PathPoint> path =
      m.legs > 1 ? drive_legs(params, where) : drive_along(params, kStepsPerFrame, where);
  const SmoothNoise pitch(&random, m.sway_hz), roll(&random, m.sway_hz), yaw(&random, m.sway_hz),
      lift(&random, m.sway_hz), glance(&random, m.glance_hz);
  std::vector<SE3> poses;
  for (size_t i = 0; i < path.size(); ++i) {
    const double t = seconds_at(i, params.rate_hz), sway = rad(m.sway_deg);
    const Eigen::Vector3d position(path[i].x, path[i].y, m.height + m.sway_m * lift(t));
    const double aside = rad(m.glance_deg) * glance(t) - rad(m.look_right_deg);
    poses.push_back(look(position, path[i].yaw + aside + sway / 3 * yaw(t),
                         rad(m.look_down_deg) + sway * pitch(t), rad(m.roll_deg) + sway * roll(t)));
  }
  return poses;
}

// From angle a to angle b, the shorter way round.
double turned(double a, double b, double share) { return a + share * std::remainder(b - a, rad(360)); }

// A view of a hand-held camera: where it is held, and the point at which it looks.
struct HeldView {
  Eigen::Vector3d eye, target;
  double yaw_from(const Eigen::Vector3d& p) const {
    return std::atan2(target.y() - p.y(), target.x() - p.x());
  }
  double down_from(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d view = target - p;
    return std::atan2(-view.z(), view.head<2>().norm());
  }
};

// The pairs of waypoints, held one after the other; staying and passing to the next take equally long.
class HeldViews {
 public:
  explicit HeldViews(const std::vector<Eigen::Vector3d>& waypoints) {
    for (size_t i = 0; i + 1 < waypoints.size(); i += 2) views_.push_back({waypoints[i], waypoints[i + 1]});
  }
  // Where the camera is and looks after a share of the time, moved by `off`.
  void at(double share, const Eigen::Vector3d& off, Eigen::Vector3d* p, double* yaw, double* down) const {
    const double part = std::clamp(share, 0.0, 1.0) * double(2 * views_.size() - 1);
    const size_t i = std::min(size_t(part / 2), views_.size() - 1), next = std::min(i + 1, views_.size() - 1);
    const double t = std::clamp(part - double(2 * i) - 1, 0.0, 1.0), passed = t * t * (3 - 2 * t);
    *p = views_[i].eye + passed * (views_[next].eye - views_[i].eye) + off;
    *yaw = turned(views_[i].yaw_from(*p), views_[next].yaw_from(*p), passed);
    *down = views_[i].down_from(*p) + passed * (views_[next].down_from(*p) - views_[i].down_from(*p));
  }

 private:
  std::vector<HeldView> views_;
};

// Moves about the first waypoint, always looking near the second, or about one such pair after the other.
// Time is scaled to give the requested mean speed about a waypoint.
std::vector<SE3> hand(const SceneParams& params, Random random) {
  const MotionParams& m = params.motion;
  const SmoothNoise x(&random, 0.25), y(&random, 0.25), z(&random, 0.25);
  const SmoothNoise yaw(&random, m.sway_hz), down(&random, m.sway_hz), roll(&random, m.sway_hz);
  const auto off = [&](double t) -> Eigen::Vector3d {
    return 0.55 * m.amplitude * Eigen::Vector3d(x(t), y(t), z(t));
  };
  const HeldViews views(params.waypoints);
  double length = 0;
  constexpr double kStep = 0.01, kSeconds = 200;
  for (double t = 0; t < kSeconds; t += kStep) length += (off(t + kStep) - off(t)).norm();
  const double pace = m.speed / (length / kSeconds), sway = rad(m.sway_deg);
  std::vector<SE3> poses;
  for (size_t i = 0; i < size_t(params.frames) * kStepsPerFrame; ++i) {
    const double t = seconds_at(i, params.rate_hz);
    Eigen::Vector3d p;
    double view_yaw = 0, view_down = 0;
    views.at(double(i) / double(params.frames * kStepsPerFrame), off(pace * t), &p, &view_yaw, &view_down);
    poses.push_back(look(p, view_yaw + sway * yaw(t), view_down + sway * down(t), sway * roll(t)));
  }
  return poses;
}

}  // namespace

SE3 look(const Eigen::Vector3d& position, double yaw, double down, double roll) {
  const Eigen::Vector3d forward(std::cos(yaw) * std::cos(down), std::sin(yaw) * std::cos(down),
                                -std::sin(down));
  const Eigen::Vector3d level = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d right = Eigen::AngleAxisd(roll, forward) * level;
  Eigen::Matrix3d R;
  R.col(0) = right, R.col(1) = forward.cross(right), R.col(2) = forward;
  return {R, position};
}

SE3 CameraMotion::at(double seconds) const {
  const double steps = seconds / step_s;
  const size_t i = size_t(std::clamp(std::floor(steps), 0.0, double(T_scene_cam.size() - 2)));
  return T_scene_cam[i] *
         SE3::exp((steps - double(i)) * (T_scene_cam[i].inverse() * T_scene_cam[i + 1]).log());
}

CameraMotion make_trajectory(const SceneParams& params, uint64_t seed, const std::string& where,
                             uint64_t draw) {
  const Random random = Random::derive(seed, kMotionPurpose + draw);
  return {1 / params.rate_hz / kStepsPerFrame,
          params.motion.kind == "hand" ? hand(params, random) : drive(params, random, where)};
}

}  // namespace edgevo
