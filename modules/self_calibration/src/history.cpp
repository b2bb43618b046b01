// SPDX-License-Identifier: BSD-3-Clause
#include "history.h"

#include <algorithm>
#include <map>
#include <utility>

#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/map/corrected_pixel.h"

namespace edgevo {
namespace {

// Number of newest keyframes of an estimate that define its unit of length: those covisible with the newest
// one, from which the map continues; a median needs no more.
constexpr size_t kNewestSpan = 8;

void add_point(const Rectification& c, const ImageCorrection& now, const MapPoint& p, int host,
               const std::map<int, int>& pose_of_id, CalibrationHistory* h) {
  BaProblem& file = h->problem.file;
  const ImageCorrection none;
  const int index = int(file.points.size());
  const size_t before = file.observations.size();
  for (const Observation& o : p.observations) {
    const auto target = pose_of_id.find(o.keyframe_id);
    if (target == pose_of_id.end()) continue;
    const ImageMotion& motion = h->problem.motion_of(target->second);
    const Eigen::Vector2d normal = correct_normal(c, now, none, motion, o.match.px, o.match.normal);
    file.observations.push_back({index, target->second, correct_pixel(c, now, none, motion, o.match.px),
                                 normal, o.match.inv_sigma_normal, 0.0});
  }
  if (file.observations.size() == before) return;
  file.points.push_back({host, Eigen::Vector3d::Zero(), p.idepth, is_depth_fixed(p)});
  h->problem.px_host.push_back(correct_pixel(c, now, none, h->problem.motion_of(host), p.px));
  h->point_index[host].push_back(index);
}

// Inverse depths by pixel in one host. The pixel identifies a point, since points come and go between two
// histories.
using IdepthAt = std::map<std::pair<double, double>, double>;
std::pair<double, double> pixel_key(const CalibrationHistory& h, int i) {
  return {h.problem.px_host[i].x(), h.problem.px_host[i].y()};
}

IdepthAt idepths_of_host(const CalibrationHistory& h, const BaProblem& solution, size_t host) {
  IdepthAt idepths;
  for (const int i : h.point_index[host])
    if (i >= 0) idepths[pixel_key(h, i)] = solution.points[i].idepth;
  return idepths;
}

// Sets the points of `p` to the solution's inverse depths, and scales new ones by the same ratio. Returns new
// over old inverse depth at the newest known keyframes.
double carry_idepths(const CalibrationHistory& then, const BaProblem& solution, const CalibrationHistory& now,
                     BaProblem* p) {
  const size_t known = then.problem.file.poses.size();
  std::vector<bool> is_new(p->points.size(), true);
  std::vector<double> ratios;
  for (size_t host = 0; host < known; ++host) {
    const IdepthAt idepths = idepths_of_host(then, solution, host);
    for (const int i : now.point_index[host]) {
      const auto found = i >= 0 ? idepths.find(pixel_key(now, i)) : idepths.end();
      if (found == idepths.end()) continue;
      if (host + kNewestSpan >= known) ratios.push_back(found->second / p->points[i].idepth);
      p->points[i].idepth = found->second;
      is_new[i] = false;
    }
  }
  const double ratio = ratios.empty() ? 1.0 : median(std::move(ratios));
  for (size_t i = 0; i < p->points.size(); ++i)
    if (is_new[i]) p->points[i].idepth *= ratio;
  return ratio;
}

// Sets the first poses of `p` to those of the solution; the others keep their motion against the newest of
// them, with lengths multiplied by `length`.
void carry_poses(const BaProblem& solution, double length, BaProblem* p) {
  const size_t known = solution.poses.size();
  const SE3 T_newest_world = p->poses[known - 1].T_cam_world;
  for (size_t k = 0; k < known; ++k) p->poses[k].T_cam_world = solution.poses[k].T_cam_world;
  for (size_t k = known; k < p->poses.size(); ++k) {
    const SE3 T_k_newest = p->poses[k].T_cam_world * T_newest_world.inverse();
    const SE3 in_unit(T_k_newest.rotation(), length * T_k_newest.translation());
    p->poses[k].T_cam_world = in_unit * p->poses[known - 1].T_cam_world;
  }
}

}  // namespace

std::vector<const Keyframe*> all_keyframes(const Map& map) {
  std::vector<const Keyframe*> keyframes;
  for (const Keyframe& k : map.marginalised()) keyframes.push_back(&k);
  for (const Keyframe& k : map.active()) keyframes.push_back(&k);
  return keyframes;
}

CalibrationHistory make_history(const Rectification& rectification, const ImageCorrection& now,
                                const std::vector<const Keyframe*>& keyframes) {
  CalibrationHistory h;
  h.problem.rectification = rectification;
  h.problem.is_in_doubt = keyframes.back()->is_doubtful;
  BaProblem& file = h.problem.file;
  file.pinhole = rectification.target();
  std::map<int, int> pose_of_id;
  for (const Keyframe* k : keyframes) {
    pose_of_id[k->id] = int(file.poses.size());
    file.poses.push_back({k->T_cam_world, false});
    file.pose_ids.push_back(k->id);
    h.problem.motion.push_back(k->motion);
  }
  file.poses.front().fixed = true;
  // The gauge: the first pose, and the distance from it to the newest one.
  const Keyframe& newest = *keyframes.back();
  file.prior = ba::fix_baseline(keyframes.front()->T_cam_world, newest.T_cam_world, newest.id);
  h.point_index.resize(keyframes.size());
  for (size_t host = 0; host < keyframes.size(); ++host)
    for (const MapPoint& p : keyframes[host]->points) {
      const size_t known = h.point_index[host].size();
      add_point(rectification, now, p, int(host), pose_of_id, &h);
      if (h.point_index[host].size() == known) h.point_index[host].push_back(-1);
    }
  return h;
}

BaProblem carry_over(const CalibrationHistory& then, const CameraEstimate& estimate,
                     const CalibrationHistory& now) {
  BaProblem p = corrected(now.problem, estimate.value);
  const double idepth_ratio = carry_idepths(then, estimate.solution, now, &p);
  carry_poses(estimate.solution, 1.0 / idepth_ratio, &p);
  return p;
}

}  // namespace edgevo
