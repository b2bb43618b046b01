// SPDX-License-Identifier: BSD-3-Clause
#include "held_back.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "edgevo/core/mean_and_error.h"

namespace edgevo {
namespace {

constexpr int kEvery = 5;
// Weight of the inverse sigma of a held-back match while the rest is adjusted: it keeps its own keyframe from
// drifting off and moves nothing else.
constexpr double kHeldWeight = 1e-3;
// Factor on the tolerance of the first of two adjustments.
constexpr double kFirstTolerance = 10;
constexpr double kMinDepth = 1e-3;

bool is_held_back(int pose) { return pose % kEvery == kEvery - 1; }

CameraProblem without_held_back(const CameraProblem& problem, const BaProblem& start) {
  CameraProblem rest = problem;
  rest.file.poses = start.poses;
  for (size_t i = 0; i < start.points.size(); ++i) rest.file.points[i].idepth = start.points[i].idepth;
  for (BaObservation& o : rest.file.observations)
    if (is_held_back(o.target)) o.inv_sigma_normal *= kHeldWeight;
  return rest;
}

// Poses and depths for a camera that is given; nothing if the adjustment fails. Twice, since the first ends
// early where it starts far off.
std::optional<BaProblem> fit_map(const CameraProblem& problem, const CameraError& camera,
                                 const BaOptions& options) {
  const auto solver = make_bundle_adjuster("schur");
  BaProblem map = corrected(problem, camera);
  BaOptions rough = options;
  rough.relative_decrease *= kFirstTolerance;
  if (!solver->solve(&map, rough).usable || !solver->solve(&map, options).usable) return std::nullopt;
  return map;
}

// Places the held-back keyframes by their matches, in a map that stays.
BaProblem place_held_back(BaProblem map, const BaOptions& options) {
  for (size_t i = 0; i < map.poses.size(); ++i) map.poses[i].fixed = !is_held_back(int(i));
  for (BaPoint& p : map.points) p.fixed = true;
  auto& o = map.observations;
  o.erase(std::remove_if(o.begin(), o.end(), [](const BaObservation& m) { return !is_held_back(m.target); }),
          o.end());
  for (BaObservation& m : o) m.inv_sigma_normal /= kHeldWeight;
  map.corners.clear();
  map.prior.reset();
  make_bundle_adjuster("schur")->solve(&map, options);
  return map;
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
  if (!(Y.z() > kMinDepth)) return std::numeric_limits<double>::quiet_NaN();
  return huber(o.normal.dot(p.pinhole.project(Y) - o.px) * o.inv_sigma_normal, width);
}

}  // namespace

HeldBack compare_on_held_back(const CameraProblem& problem, const CameraEstimate& e, const CameraError& file,
                              const BaOptions& options) {
  // Both from the same start: the map as the estimate leaves it.
  const CameraProblem rest = without_held_back(problem, e.solution);
  const std::optional<BaProblem> estimated = fit_map(rest, e.value, options),
                                 as_given = fit_map(rest, file, options);
  if (!estimated || !as_given) return {};
  const BaProblem a = place_held_back(*as_given, options), b = place_held_back(*estimated, options);
  std::map<int, double> by_keyframe;
  for (size_t i = 0; i < a.observations.size(); ++i) {
    const double difference = cost_of(a, a.observations[i], options.huber_width) -
                              cost_of(b, b.observations[i], options.huber_width);
    if (!std::isfinite(difference)) continue;
    by_keyframe[a.observations[i].target] += difference;
  }
  std::vector<double> gains;
  for (const auto& [target, gain] : by_keyframe) gains.push_back(gain);
  const MeanAndError gain = mean_and_error(gains);
  return {gain.mean, gain.error, int(gains.size())};
}

}  // namespace edgevo
