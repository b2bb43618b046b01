#include "calibration_history.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

using ba::CameraEstimate;

constexpr int kGaugeSpan = 8;      // keyframes over which the scale of a new prior is held
constexpr size_t kNewestSpan = 8;  // the newest keyframes that an estimate knew: they tell its unit of length

bool is_fixed(const MapPoint& p) {
  return std::all_of(p.observations.begin(), p.observations.end(),
                     [](const Observation& o) { return o.match.kind == MatchKind::kEdgeFixed; });
}

void add_point(const Pinhole& c, const ImageCorrection& now, const MapPoint& p, int host, const std::map<int, int>& pose_of_id,
               CalibrationHistory* h) {
  BaProblem& file = h->problem.file;
  const ImageCorrection none;
  const int index = int(file.points.size());
  const size_t before = file.observations.size();
  for (const Observation& o : p.observations) {
    const auto target = pose_of_id.find(o.keyframe_id);
    if (target == pose_of_id.end()) continue;
    const ImageMotion& motion = h->problem.motion_of(target->second);
    file.observations.push_back({index, target->second, correct_pixel(c, now, none, motion, o.match.px),
                                 correct_normal(c, now, none, motion, o.match.px, o.match.normal), o.match.inv_sigma_normal, 0.0});
  }
  if (file.observations.size() == before) return;
  file.points.push_back({host, Eigen::Vector3d::Zero(), p.idepth, is_fixed(p)});
  h->problem.px_host.push_back(correct_pixel(c, now, none, h->problem.motion_of(host), p.px));
  h->point_index[host].push_back(index);
}

// The gauge: the first pose, and the distance from it to the newest along the way between them.
BaPrior hold_ends(const SE3& first, const SE3& newest, int newest_id) {
  const Eigen::Vector3d way = (newest * first.inverse()).translation();
  const double sigma = 1e-4 * std::max(way.norm(), 1e-9);
  BaPrior prior;
  prior.pose_ids = {newest_id};
  prior.linearization = {newest};
  prior.H = Eigen::MatrixXd::Zero(6, 6);
  prior.H.topLeftCorner<3, 3>() = way.normalized() * way.normalized().transpose() / (sigma * sigma);
  prior.b = Eigen::VectorXd::Zero(6);
  return prior;
}

// Median of new over old inverse depth of the points of some keyframes; 1 where there are none.
double idepth_ratio(const std::vector<const Keyframe*>& keyframes, size_t from, size_t to, const CalibrationHistory& h,
                    const BaProblem& solution) {
  std::vector<double> ratios;
  for (size_t k = from; k < to; ++k)
    for (size_t i = 0; i < keyframes[k]->points.size(); ++i)
      if (h.point_index[k][i] >= 0) ratios.push_back(solution.points[h.point_index[k][i]].idepth / keyframes[k]->points[i].idepth);
  return ratios.empty() ? 1.0 : median(std::move(ratios));
}

// Moves a solution so that the newest keyframe keeps its pose, and lengths around it their unit.
void anchor(const SE3& newest, double length, BaProblem* solution) {
  const SE3 from = solution->poses.back().T_cam_world;
  for (BaPose& pose : solution->poses) {
    const SE3 T_i_newest = pose.T_cam_world * from.inverse();
    pose.T_cam_world = SE3(T_i_newest.rotation(), length * T_i_newest.translation()) * newest;
  }
  for (BaPoint& p : solution->points) p.idepth /= length;
}

// Poses [begin, end) of a problem with the points that the first of them hosts.
BaProblem first_host_problem(const BaProblem& all, int begin, int end, const std::vector<int>& first_point,
                             const std::vector<int>& first_observation) {
  BaProblem part;
  part.pinhole = all.pinhole;
  part.poses.assign(all.poses.begin() + begin, all.poses.begin() + end);
  part.pose_ids.assign(all.pose_ids.begin() + begin, all.pose_ids.begin() + end);
  for (int i = first_point[begin]; i < first_point[begin + 1]; ++i) {
    const int index = int(part.points.size());
    const size_t before = part.observations.size();
    for (int k = first_observation[i]; k < first_observation[i + 1]; ++k) {
      BaObservation o = all.observations[k];
      if (o.target <= begin || o.target >= end) continue;
      o.point = index;
      o.target -= begin;
      part.observations.push_back(o);
    }
    if (part.observations.size() == before) continue;
    part.points.push_back(all.points[i]);
    part.points.back().host = 0;
  }
  return part;
}

// Marginalises the first `count` poses one after another, as the window would have done.
BaPrior marginalize_first(const BaProblem& solution, int count, const BaOptions& options) {
  if (count == 0) return {};
  const int n = int(solution.poses.size());
  std::vector<int> first_point(n + 1, 0), first_observation(solution.points.size() + 1, 0);
  for (const BaPoint& p : solution.points) ++first_point[p.host + 1];
  for (int i = 0; i < n; ++i) first_point[i + 1] += first_point[i];
  for (const BaObservation& o : solution.observations) ++first_observation[o.point + 1];
  for (size_t i = 1; i < first_observation.size(); ++i) first_observation[i] += first_observation[i - 1];
  const int held = std::min(n - 1, kGaugeSpan);  // the first pose, and its distance to this one, fix the gauge
  int span = held + 1;                           // keyframes that any one shares points with, itself included
  for (const BaObservation& o : solution.observations) span = std::max(span, o.target - solution.points[o.point].host + 1);
  BaPrior prior = hold_ends(solution.poses[0].T_cam_world, solution.poses[held].T_cam_world, solution.pose_ids[held]);
  std::vector<bool> drop;
  for (int i = 0; i < count; ++i) {
    BaProblem part = first_host_problem(solution, i, std::min(n, i + span), first_point, first_observation);
    part.poses[0].fixed = i == 0;
    part.prior = prior;
    prior = marginalize(part, part.pose_ids[0], options, &drop);
  }
  return prior;
}

RevisedKeyframe revise(const Pinhole& c, const ImageCorrection& before, const ImageCorrection& now, const Keyframe& k,
                       const SE3& T_cam_world, double ratio, const std::vector<int>& point_index, const BaProblem& solution) {
  RevisedKeyframe r;
  r.id = k.id;
  r.motion = k.motion;
  r.T_cam_world = T_cam_world;
  r.length_ratio = 1.0 / ratio;
  for (size_t i = 0; i < k.points.size(); ++i) {
    const double idepth = point_index[i] >= 0 ? solution.points[point_index[i]].idepth : k.points[i].idepth * ratio;
    r.points.push_back({correct_pixel(c, before, now, k.motion, k.points[i].px), idepth});
  }
  return r;
}

// Inverse depths by place in one host: what a point is known by, since points come and go between two histories.
using IdepthAt = std::map<std::pair<double, double>, double>;
std::pair<double, double> place(const CalibrationHistory& h, int i) { return {h.problem.px_host[i].x(), h.problem.px_host[i].y()}; }

IdepthAt idepths_of_host(const CalibrationHistory& h, const BaProblem& solution, size_t host) {
  IdepthAt idepths;
  for (const int i : h.point_index[host])
    if (i >= 0) idepths[place(h, i)] = solution.points[i].idepth;
  return idepths;
}

// Gives the points of `p` the solution's inverse depths, new ones scaled alike; returns new over old inverse depth at the newest known
// keyframes.
double carry_idepths(const CalibrationHistory& then, const BaProblem& solution, const CalibrationHistory& now, BaProblem* p) {
  const size_t known = then.problem.file.poses.size();
  std::vector<bool> is_new(p->points.size(), true);
  std::vector<double> ratios;
  for (size_t host = 0; host < known; ++host) {
    const IdepthAt idepths = idepths_of_host(then, solution, host);
    for (const int i : now.point_index[host]) {
      const auto found = i >= 0 ? idepths.find(place(now, i)) : idepths.end();
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

// Gives the first poses of `p` those of the solution; the others keep their motion against the newest of them, lengths times `length`.
void carry_poses(const BaProblem& solution, double length, BaProblem* p) {
  const size_t known = solution.poses.size();
  const SE3 T_newest_world = p->poses[known - 1].T_cam_world;
  for (size_t k = 0; k < known; ++k) p->poses[k].T_cam_world = solution.poses[k].T_cam_world;
  for (size_t k = known; k < p->poses.size(); ++k) {
    const SE3 T_k_newest = p->poses[k].T_cam_world * T_newest_world.inverse();
    p->poses[k].T_cam_world = SE3(T_k_newest.rotation(), length * T_k_newest.translation()) * p->poses[known - 1].T_cam_world;
  }
}

}  // namespace

CalibrationHistory make_history(const Pinhole& pinhole, const ImageCorrection& now, const std::vector<const Keyframe*>& keyframes) {
  CalibrationHistory h;
  BaProblem& file = h.problem.file;
  file.pinhole = pinhole;
  std::map<int, int> pose_of_id;
  for (const Keyframe* k : keyframes) {
    pose_of_id[k->id] = int(file.poses.size());
    file.poses.push_back({k->T_cam_world, false});
    file.pose_ids.push_back(k->id);
    h.problem.motion.push_back(k->motion);
  }
  file.poses.front().fixed = true;
  file.prior = hold_ends(keyframes.front()->T_cam_world, keyframes.back()->T_cam_world, keyframes.back()->id);
  h.point_index.resize(keyframes.size());
  for (size_t host = 0; host < keyframes.size(); ++host)
    for (const MapPoint& p : keyframes[host]->points) {
      const size_t known = h.point_index[host].size();
      add_point(pinhole, now, p, int(host), pose_of_id, &h);
      if (h.point_index[host].size() == known) h.point_index[host].push_back(-1);
    }
  return h;
}

BaProblem carry_over(const CalibrationHistory& then, const CameraEstimate& estimate, const CalibrationHistory& now) {
  BaProblem p = ba::corrected(now.problem, estimate.value);
  const double idepth_ratio = carry_idepths(then, estimate.solution, now, &p);
  carry_poses(estimate.solution, 1.0 / idepth_ratio, &p);
  return p;
}

MapRevision make_revision(const Pinhole& c, const ImageCorrection& before, const std::vector<const Keyframe*>& keyframes,
                          size_t remembered, const CalibrationHistory& history, const BaOptions& options, CameraEstimate* e) {
  const size_t n = keyframes.size();
  anchor(keyframes.back()->T_cam_world, idepth_ratio(keyframes, remembered, n, history, e->solution), &e->solution);
  MapRevision r;
  r.before = before;
  r.now = e->value;
  for (size_t k = 0; k < n; ++k)
    r.keyframes.push_back(revise(c, before, e->value, *keyframes[k], e->solution.poses[k].T_cam_world,
                                 idepth_ratio(keyframes, k, k + 1, history, e->solution), history.point_index[k], e->solution));
  r.prior = marginalize_first(e->solution, int(remembered), options);
  return r;
}

void apply_to_history(const Pinhole& c, const MapRevision& revision, std::vector<Keyframe>* history) {
  for (size_t h = 0; h < history->size(); ++h) {
    Keyframe& k = (*history)[h];
    const RevisedKeyframe& r = revision.keyframes[h];
    k.T_cam_world = r.T_cam_world;
    for (size_t i = 0; i < k.points.size(); ++i) {
      k.points[i].px = r.points[i].px;
      k.points[i].idepth = r.points[i].idepth;
      for (Observation& o : k.points[i].observations) {
        const ImageMotion& motion = revision.motion_of(o.keyframe_id);
        o.match.normal = correct_normal(c, revision.before, revision.now, motion, o.match.px, o.match.normal);
        o.match.px = correct_pixel(c, revision.before, revision.now, motion, o.match.px);
      }
    }
  }
}

}  // namespace edgevo
