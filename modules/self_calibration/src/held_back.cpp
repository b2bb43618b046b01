// SPDX-License-Identifier: BSD-3-Clause
#include "held_back.h"

#include <cmath>
#include <limits>
#include <vector>

namespace edgevo {
namespace {

constexpr int kEvery = 5;
// Weight of the inverse sigma of a held-back match: it places its own keyframe and moves nothing else.
constexpr double kHeldWeight = 1e-3;
constexpr double kLeastDepth = 1e-3;
constexpr size_t kFewestMatches = 20;  // of a keyframe that counts

bool is_held_back(int pose) { return pose % kEvery == kEvery - 1; }

CameraProblem without_held_back(const CameraProblem& problem, const BaProblem& start) {
  CameraProblem rest = problem;
  rest.file.poses = start.poses;
  for (size_t i = 0; i < start.points.size(); ++i) rest.file.points[i].idepth = start.points[i].idepth;
  for (BaObservation& o : rest.file.observations)
    if (is_held_back(o.target)) o.inv_sigma_normal *= kHeldWeight;
  return rest;
}

CameraEstimate fit_map(const CameraProblem& problem, const CameraError& camera, const BaOptions& options) {
  CameraSearch search;
  search.start = camera;
  search.free = only({});
  return estimate_camera(problem, search, options);
}

double huber(double r, double width) {
  const double a = std::abs(r);
  return a <= width ? 0.5 * a * a : width * (a - 0.5 * width);
}

// Robust cost of a held-back match at a solution; NaN for a point behind the camera.
double cost_of(const BaProblem& p, const BaObservation& o, double width) {
  const BaPoint& point = p.points[size_t(o.point)];
  const SE3 T = p.poses[size_t(o.target)].T_cam_world * p.poses[size_t(point.host)].T_cam_world.inverse();
  const Eigen::Vector3d Y = T.rotation() * point.ray + point.idepth * T.translation();
  if (!(Y.z() > kLeastDepth)) return std::numeric_limits<double>::quiet_NaN();
  return huber(o.normal.dot(p.pinhole.project(Y) - o.px) * o.inv_sigma_normal / kHeldWeight, width);
}

// Differences of the costs of a keyframe's matches under two cameras.
struct Difference {
  double sum = 0;
  size_t matches = 0;
};

}  // namespace

HeldBack compare_on_held_back(const CameraProblem& problem, const CameraEstimate& e,
                              const ImageCorrection& file, const BaOptions& options) {
  HeldBack result;
  // Both from the same start: the map as the estimate leaves it.
  const CameraProblem rest = without_held_back(problem, e.solution);
  const CameraEstimate estimated = fit_map(rest, e.value, options), as_given = fit_map(rest, file, options);
  if (!estimated.usable || !as_given.usable) return result;
  std::vector<Difference> by_keyframe(rest.file.poses.size());
  const BaProblem &a = as_given.solution, &b = estimated.solution;
  for (size_t i = 0; i < a.observations.size(); ++i) {
    if (!is_held_back(a.observations[i].target)) continue;
    const double difference = cost_of(a, a.observations[i], options.huber_width) -
                              cost_of(b, b.observations[i], options.huber_width);
    if (!std::isfinite(difference)) continue;
    Difference& d = by_keyframe[size_t(a.observations[i].target)];
    d.sum += difference, ++d.matches;
  }
  double sum = 0;
  for (const Difference& d : by_keyframe) {
    if (d.matches < kFewestMatches) continue;
    sum += d.sum / double(d.matches), ++result.keyframes;
  }
  if (result.keyframes > 0) result.gain = sum / result.keyframes;
  return result;
}

}  // namespace edgevo
