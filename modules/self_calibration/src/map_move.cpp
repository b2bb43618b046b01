// SPDX-License-Identifier: BSD-3-Clause
#include "map_move.h"

#include <algorithm>

#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/bundle_adjustment/problem_index.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/map/corrected_pixel.h"

namespace edgevo {
namespace {

// Keyframes over which the scale of a new prior is fixed: a longer baseline than that of two neighbours, and
// still covisible with the first. Only a gauge.
constexpr int kGaugeSpan = 8;

// Median of new over old inverse depth of the points of some keyframes; 1 without points.
double idepth_ratio(const std::vector<const Keyframe*>& keyframes, size_t from, size_t to,
                    const CalibrationHistory& h, const BaProblem& solution) {
  std::vector<double> ratios;
  for (size_t k = from; k < to; ++k)
    for (size_t i = 0; i < keyframes[k]->points.size(); ++i)
      if (const int index = h.point_index[k][i]; index >= 0)
        ratios.push_back(solution.points[index].idepth / keyframes[k]->points[i].idepth);
  return ratios.empty() ? 1.0 : median(std::move(ratios));
}

// Moves a solution so that the newest keyframe keeps its pose, and lengths around it their unit. Returns the
// poses relative to the newest keyframe.
std::vector<SE3> anchor(const SE3& newest, double length, BaProblem* solution) {
  const SE3 from = solution->poses.back().T_cam_world;
  std::vector<SE3> T_cam_newest;
  for (BaPose& pose : solution->poses) {
    const SE3 T_i_newest = pose.T_cam_world * from.inverse();
    T_cam_newest.emplace_back(T_i_newest.rotation(), length * T_i_newest.translation());
    pose.T_cam_world = T_cam_newest.back() * newest;
  }
  for (BaPoint& p : solution->points) p.idepth /= length;
  return T_cam_newest;
}

// Marginalises the first `count` poses one after another, as the window would have done.
BaPrior marginalize_first(const BaProblem& solution, int count, const BaOptions& options) {
  if (count == 0) return {};
  const int n = int(solution.poses.size());
  const ba::ProblemIndex index = ba::index_problem(solution);
  // The first pose, and its distance to this one, fix the gauge.
  const int held = std::min(n - 1, kGaugeSpan);
  int span = held + 1;  // keyframes that any one shares points with, itself included
  for (const BaObservation& o : solution.observations)
    span = std::max(span, o.target - solution.points[o.point].host + 1);
  BaPrior prior = ba::fix_baseline(solution.poses[0].T_cam_world, solution.poses[held].T_cam_world,
                                   solution.pose_ids[held]);
  std::vector<bool> drop;
  for (int i = 0; i < count; ++i) {
    BaProblem part = ba::problem_of_host(solution, index, i, std::min(n, i + span));
    part.poses[0].fixed = i == 0;
    part.prior = prior;
    prior = marginalize(part, part.pose_ids[0], options, &drop);
  }
  return prior;
}

KeyframeMove make_keyframe_move(const Rectification& c, const LensChange& lens, const Keyframe& k,
                                const SE3& T_cam_newest, double ratio, const std::vector<int>& point_index,
                                const BaProblem& solution) {
  KeyframeMove m;
  m.id = k.id;
  m.motion = k.motion;
  m.T_cam_newest = T_cam_newest;
  m.scale_ratio = 1.0 / ratio;
  for (size_t i = 0; i < k.points.size(); ++i) {
    const double idepth =
        point_index[i] >= 0 ? solution.points[point_index[i]].idepth : k.points[i].idepth * ratio;
    m.points.push_back({correct_pixel(c, lens.before, lens.now, k.motion, k.points[i].px), idepth});
  }
  return m;
}

}  // namespace

MapMoved make_move(const Rectification& c, const ImageCorrection& before,
                   const std::vector<const Keyframe*>& keyframes, size_t marginalised,
                   const CalibrationHistory& history, const BaOptions& options, CameraEstimate* e) {
  const size_t n = keyframes.size();
  const double length = idepth_ratio(keyframes, marginalised, n, history, e->solution);
  const std::vector<SE3> T_cam_newest = anchor(keyframes.back()->T_cam_world, length, &e->solution);
  MapMoved moved;
  moved.reason = MoveReason::kCamera;
  moved.lens = LensChange{before, e->value.correction};
  for (size_t k = 0; k < n; ++k) {
    const double ratio = idepth_ratio(keyframes, k, k + 1, history, e->solution);
    moved.keyframes.push_back(make_keyframe_move(c, *moved.lens, *keyframes[k], T_cam_newest[k], ratio,
                                                 history.point_index[k], e->solution));
  }
  moved.prior = marginalize_first(e->solution, int(marginalised), options);
  return moved;
}

}  // namespace edgevo
