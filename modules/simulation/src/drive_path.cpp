// SPDX-License-Identifier: BSD-3-Clause
#include "drive_path.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

using Points = std::vector<Eigen::Vector2d>;
constexpr double kStep = 0.05;  // metres between the points of a sampled path

Eigen::Vector2d left_of(const Eigen::Vector2d& d) { return {-d.y(), d.x()}; }
double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Points flat(const std::vector<Eigen::Vector3d>& points, const std::string& where) {
  Points out;
  for (const Eigen::Vector3d& p : points) out.push_back(p.head<2>());
  for (size_t i = 1; i < out.size(); ++i)
    if ((out[i] - out[i - 1]).norm() < 0.1)
      throw InputError(where, "two waypoints lie closer than 0.1 m", "remove one of them");
  return out;
}

constexpr double kLaneChange = 12;  // metres in which the offset of the second lap is taken up

// Where the legs before and after point i meet, shifted to the right by `offset`.
Eigen::Vector2d shifted_corner(const Points& path, size_t i, double offset) {
  const Eigen::Vector2d in = i > 0 ? (path[i] - path[i - 1]).normalized() : (path[1] - path[0]).normalized();
  const Eigen::Vector2d on = i + 1 < path.size() ? (path[i + 1] - path[i]).normalized() : in;
  const Eigen::Vector2d right = -left_of(in) - left_of(on);
  return path[i] + 2 * offset * right / std::max(0.5, right.squaredNorm());
}

// The path shifted to the right, on the second lap by more.
Points shifted(const Points& path, const MotionParams& m) {
  const size_t lap = m.second_lap > 0 ? size_t(m.second_lap) : path.size();
  Points out;
  for (size_t i = 0; i < path.size(); ++i) {
    out.push_back(shifted_corner(path, i, m.lane_offset + (i > lap ? m.second_offset : 0)));
    if (i != lap || m.second_offset == 0) continue;
    const Eigen::Vector2d on = (path[i + 1] - path[i]).normalized();
    out.push_back(path[i] + kLaneChange * on - (m.lane_offset + m.second_offset) * left_of(on));
  }
  return out;
}

void check_second_lap(const MotionParams& m, const Points& path, const std::string& where) {
  if (m.second_lap == 0) return;
  const size_t lap = size_t(m.second_lap);
  if (lap + 1 >= path.size())
    throw InputError(where,
                     "no leg follows waypoint " + std::to_string(lap) + ", where the second lap begins",
                     "make motion.second_lap smaller");
  const Eigen::Vector2d in = (path[lap] - path[lap - 1]).normalized(), on = path[lap + 1] - path[lap];
  if (m.second_offset != 0 && (std::abs(cross(in, on.normalized())) > 1e-3 || in.dot(on) < 2 * kLaneChange))
    throw InputError(where, "the second lap does not begin on a straight of 24 m",
                     "begin it at a waypoint within a straight, or remove motion.second_offset");
}

void append_line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Points* out) {
  const int n = std::max(1, int((b - a).norm() / kStep));
  for (int i = 0; i < n; ++i) out->push_back(a + (b - a) * (double(i) / n));
}

// Straight legs joined by arcs of `radius`, sampled.
Points rounded(const Points& path, double radius, const std::string& where) {
  Points out;
  Eigen::Vector2d start = path.front();
  for (size_t i = 1; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d in = (path[i] - path[i - 1]).normalized(),
                          on = (path[i + 1] - path[i]).normalized();
    const double angle = std::atan2(cross(in, on), in.dot(on));
    const double setback = radius * std::tan(std::abs(angle) / 2);
    if (setback > (path[i] - start).dot(in) || setback > (path[i + 1] - path[i]).norm())
      throw InputError(where,
                       "the leg before or after waypoint " + std::to_string(i) + " is too short for its turn",
                       "make motion.turn_radius smaller");
    const Eigen::Vector2d entry = path[i] - setback * in;
    append_line(start, entry, &out);
    const Eigen::Vector2d centre = entry + std::copysign(radius, angle) * left_of(in);
    const int n = std::max(1, int(radius * std::abs(angle) / kStep));
    for (int k = 0; k < n; ++k) {
      const double a = angle * k / n, c = std::cos(a), s = std::sin(a);
      const Eigen::Vector2d arm = entry - centre;
      out.push_back(centre + Eigen::Vector2d(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y()));
    }
    start = path[i] + setback * on;
  }
  append_line(start, path.back(), &out);
  out.push_back(path.back());
  return out;
}

// Moving average, three times over: curvature then has no jumps, as when a driver turns the wheel.
Points smoothed(Points path, double length) {
  const int half = std::max(1, int(length / kStep / 2));
  for (int pass = 0; pass < 3; ++pass) {
    Points out = path;
    for (int i = 0; i < int(path.size()); ++i) {
      const int reach = std::min({half, i, int(path.size()) - 1 - i});
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for (int k = -reach; k <= reach; ++k) sum += path[size_t(i + k)];
      out[size_t(i)] = sum / double(2 * reach + 1);
    }
    path = std::move(out);
  }
  return path;
}

// A sampled path: its points, the distance gone and the speed at each.
struct SampledPath {
  Points points;
  std::vector<double> gone, speed;
};

Eigen::Vector2d direction(const Points& p, size_t i) {
  const size_t a = i > 2 ? i - 3 : 0, b = std::min(p.size() - 1, i + 3);
  return (p[b] - p[a]).normalized();
}

void limit_speed(const MotionParams& m, double stop_at, SampledPath* path) {
  const size_t n = path->points.size();
  path->speed.assign(n, m.speed);
  for (size_t i = 0; i + 20 < n; ++i) {  // curvature over a metre
    const double turn = std::abs(
        std::asin(std::clamp(cross(direction(path->points, i), direction(path->points, i + 20)), -1.0, 1.0)));
    const double limit = std::sqrt(m.acceleration * 20 * kStep / std::max(turn, 1e-6));
    path->speed[i + 10] = std::min(path->speed[i + 10], limit);
  }
  if (stop_at >= 0)
    for (size_t i = 0; i < n; ++i)
      path->speed[i] = std::min(
          path->speed[i], std::max(0.02, std::sqrt(2 * m.acceleration * std::abs(path->gone[i] - stop_at))));
  const auto reachable = [&](double v, size_t a, size_t b) {
    return std::sqrt(v * v + 2 * m.acceleration * std::abs(path->gone[a] - path->gone[b]));
  };
  for (size_t i = 1; i < n; ++i)
    path->speed[i] = std::min(path->speed[i], reachable(path->speed[i - 1], i, i - 1));
  for (size_t i = n - 1; i-- > 0;)
    path->speed[i] = std::min(path->speed[i], reachable(path->speed[i + 1], i, i + 1));
}

SampledPath make_path(const SceneParams& params, double stop_share, const std::string& where) {
  const MotionParams& m = params.motion;
  SampledPath path;
  const Points flat_path = flat(params.waypoints, where);
  check_second_lap(m, flat_path, where);
  path.points = smoothed(rounded(shifted(flat_path, m), m.turn_radius, where), 0.35 * m.turn_radius);
  path.gone.push_back(0);
  for (size_t i = 1; i < path.points.size(); ++i)
    path.gone.push_back(path.gone.back() + (path.points[i] - path.points[i - 1]).norm());
  limit_speed(m, stop_share < 0 ? -1 : stop_share * path.gone.back(), &path);
  return path;
}

double mix(double a, double b, double t) { return a + (b - a) * t; }

// Advances along the path in small steps of time.
class Driver {
 public:
  explicit Driver(const SampledPath& path) : path_(path) {}
  double gone() const { return s_; }
  bool at_end() const { return at_ + 2 >= path_.points.size(); }
  void advance(double seconds) {
    s_ += seconds * mix(path_.speed[at_], path_.speed[at_ + 1], share());
    while (!at_end() && path_.gone[at_ + 1] <= s_) ++at_;
  }
  PathPoint point() const {
    const double t = share();
    const Eigen::Vector2d p = path_.points[at_] + t * (path_.points[at_ + 1] - path_.points[at_]);
    const Eigen::Vector2d d = direction(path_.points, at_) * (1 - t) + direction(path_.points, at_ + 1) * t;
    return {p.x(), p.y(), std::atan2(d.y(), d.x())};
  }

 private:
  double share() const {
    return std::clamp((s_ - path_.gone[at_]) / std::max(1e-9, path_.gone[at_ + 1] - path_.gone[at_]), 0.0,
                      1.0);
  }
  const SampledPath& path_;
  size_t at_ = 0;
  double s_ = 0;
};

// Smooth from 0 to 1, with zero speed at both ends.
double ease(double t) { return t <= 0 ? 0 : t >= 1 ? 1 : t * t * (3 - 2 * t); }

}  // namespace

double seconds_along(const SceneParams& params, const std::string& where) {
  constexpr double kSecondsPerStep = 0.01;
  const SampledPath path = make_path(params, -1, where);
  Driver driver(path);
  double seconds = 0;
  for (; !driver.at_end(); seconds += kSecondsPerStep) driver.advance(kSecondsPerStep);
  return seconds;
}

std::vector<PathPoint> drive_along(const SceneParams& params, int steps_per_frame, const std::string& where) {
  const MotionParams& m = params.motion;
  const bool pauses = m.pause_turn_deg != 0;
  const SampledPath path = make_path(params, pauses ? m.pause_at : -1, where);
  const double stop = pauses ? m.pause_at * path.gone.back() : 1e18;
  const double pause_seconds =
      pauses ? 1.5 * std::abs(m.pause_turn_deg) / m.pause_rate_deg : 0;  // 1.5: peak rate of ease()
  const double dt = 1 / params.rate_hz / steps_per_frame;
  Driver driver(path);
  double paused = 0;
  std::vector<PathPoint> out;
  for (int i = 0; i < params.frames; ++i) {
    for (int k = 0; k < steps_per_frame; ++k) {
      PathPoint p = driver.point();
      if (pauses) p.yaw += rad(m.pause_turn_deg) * ease(paused / pause_seconds);
      out.push_back(p);
      if (driver.gone() >= stop && paused < pause_seconds)
        paused += dt;
      else
        driver.advance(dt);
    }
    if (driver.at_end() && i + 1 < params.frames)
      throw InputError(where,
                       "the path ends at frame " + std::to_string(i) + " of " + std::to_string(params.frames),
                       "add waypoints, or make frames or motion.speed smaller");
  }
  return out;
}

}  // namespace edgevo
