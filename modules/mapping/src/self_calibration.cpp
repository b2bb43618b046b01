#include "edgevo/mapping/self_calibration.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "edgevo/core/radial.h"
#include "radial_problem.h"

namespace edgevo {
namespace {

using ba::RadialEstimate;
using ba::RadialProblem;

constexpr int kGaugeSpan = 8;            // keyframes over which the scale of a new prior is held
constexpr double kMaxUsefulSigma = 0.004;  // a k1 known no better than this is not observed
constexpr double kModelKeyframes = 30;   // that SelfCalibrationParams::model_sigma refers to
constexpr double kMinChange = 5e-4;      // of k1; smaller corrections wait for the end of the run

double median(std::vector<double> values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool is_fixed(const MapPoint& p) {
  return std::all_of(p.observations.begin(), p.observations.end(),
                     [](const Observation& o) { return o.match.kind == MatchKind::kEdgeFixed; });
}

// Keyframes as one problem in the camera file's images.
struct History {
  RadialProblem problem;
  std::vector<std::vector<int>> point_index;  // [keyframe][point] -> problem point, -1: none
};

void add_point(const Pinhole& c, double k1, const MapPoint& p, int host, const std::map<int, int>& pose_of_id, History* h) {
  BaProblem& file = h->problem.file;
  const auto to_file = [&](const Eigen::Vector2d& px) { return correct_pixel(c, k1, 0, px); };
  const int index = int(file.points.size());
  const size_t before = file.observations.size();
  for (const Observation& o : p.observations) {
    const auto target = pose_of_id.find(o.keyframe_id);
    if (target == pose_of_id.end()) continue;
    file.observations.push_back({index, target->second, to_file(o.match.px), correct_normal(c, k1, 0, o.match.px, o.match.normal),
                                 o.match.inv_sigma_normal, 0.0});
  }
  if (file.observations.size() == before) return;
  file.points.push_back({host, Eigen::Vector3d::Zero(), p.idepth, is_fixed(p)});
  h->problem.px_host.push_back(to_file(p.px));
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

History make_history(const Pinhole& pinhole, double k1, const std::vector<const Keyframe*>& keyframes) {
  History h;
  BaProblem& file = h.problem.file;
  file.pinhole = pinhole;
  std::map<int, int> pose_of_id;
  for (const Keyframe* k : keyframes) {
    pose_of_id[k->id] = int(file.poses.size());
    file.poses.push_back({k->T_cam_world, false});
    file.pose_ids.push_back(k->id);
  }
  file.poses.front().fixed = true;
  file.prior = hold_ends(keyframes.front()->T_cam_world, keyframes.back()->T_cam_world, keyframes.back()->id);
  h.point_index.resize(keyframes.size());
  for (size_t host = 0; host < keyframes.size(); ++host)
    for (const MapPoint& p : keyframes[host]->points) {
      const size_t known = h.point_index[host].size();
      add_point(pinhole, k1, p, int(host), pose_of_id, &h);
      if (h.point_index[host].size() == known) h.point_index[host].push_back(-1);
    }
  return h;
}

// Median of new over old inverse depth of the points of some keyframes; 1 where there are none.
double idepth_ratio(const std::vector<const Keyframe*>& keyframes, size_t from, size_t to, const History& h, const BaProblem& solution) {
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

RevisedKeyframe revise(const Pinhole& c, double k1_before, double k1, const Keyframe& k, const SE3& T_cam_world, double ratio,
                       const std::vector<int>& point_index, const BaProblem& solution) {
  RevisedKeyframe r;
  r.id = k.id;
  r.T_cam_world = T_cam_world;
  r.length_ratio = 1.0 / ratio;
  for (size_t i = 0; i < k.points.size(); ++i) {
    const double idepth = point_index[i] >= 0 ? solution.points[point_index[i]].idepth : k.points[i].idepth * ratio;
    r.points.push_back({correct_pixel(c, k1_before, k1, k.points[i].px), idepth});
  }
  return r;
}

// The solution, anchored at the newest keyframe, as what became of each keyframe; the first `remembered` ones are no longer in the window.
MapRevision make_revision(const Pinhole& c, double k1_before, const std::vector<const Keyframe*>& keyframes, size_t remembered,
                          const History& history, const BaOptions& options, RadialEstimate* e) {
  const size_t n = keyframes.size();
  anchor(keyframes.back()->T_cam_world, idepth_ratio(keyframes, remembered, n, history, e->solution), &e->solution);
  MapRevision r;
  r.k1_before = k1_before;
  r.k1 = e->k1;
  for (size_t k = 0; k < n; ++k)
    r.keyframes.push_back(revise(c, k1_before, e->k1, *keyframes[k], e->solution.poses[k].T_cam_world,
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
        o.match.normal = correct_normal(c, revision.k1_before, revision.k1, o.match.px, o.match.normal);
        o.match.px = correct_pixel(c, revision.k1_before, revision.k1, o.match.px);
      }
    }
  }
}

}  // namespace

Eigen::Vector2d correct_pixel(const Pinhole& c, double k1_before, double k1, const Eigen::Vector2d& px) {
  const Eigen::Vector2d x = remove_radial(k1, add_radial(k1_before, c.ray(px).head<2>()));
  return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy};
}

// A gradient is a covector: n' ~ (d px / d px')^T n.
Eigen::Vector2d correct_normal(const Pinhole& c, double k1_before, double k1, const Eigen::Vector2d& px,
                               const Eigen::Vector2d& normal) {
  const Eigen::Vector2d x = c.ray(px).head<2>();
  const Eigen::Vector2d corrected = remove_radial(k1, add_radial(k1_before, x));
  const Eigen::Matrix2d J = radial_jacobian(k1_before, x).inverse() * radial_jacobian(k1, corrected);
  const Eigen::Vector2d f(c.fx, c.fy);
  return f.cwiseInverse().cwiseProduct(J.transpose() * f.cwiseProduct(normal)).normalized();
}

void SelfCalibrationParams::visit(ParamVisitor& v) {
  v.text("refine", refine, {"none", "k1"}, "residual radial distortion found while running; none: the file is taken as it is");
  v.integer("min_keyframes", min_keyframes, 10, 200, "at the first estimate; each further one at twice as many");
  v.integer("checkpoints", checkpoints, 1, 5, "estimates while running; the last one takes about a second; realtime: two at most");
  v.number("prior_sigma", prior_sigma, 1e-4, 1, "standard deviation of k1 before anything was seen");
  v.number("max_k1", max_k1, 1e-4, 0.2, "an estimate at this limit is not applied");
  v.number("significance", significance, 0, 100, "standard deviations from zero that an estimate needs to be applied");
  v.number("model_sigma", model_sigma, 0, 0.1, "error of k1 by biased matches after 30 keyframes; falls as their number grows");
}

SelfCalibration::SelfCalibration(const Pinhole& pinhole, const SelfCalibrationParams& params)
    : pinhole_(pinhole), params_(params), next_checkpoint_(params.min_keyframes) {
  if (params.refine != "none") state_.state = CameraRefinement::State::kTooEarly;
}

void SelfCalibration::remember(const Keyframe& keyframe) {
  if (finished_ || params_.refine == "none") return;
  history_.push_back(keyframe);
  history_.back().pyramid.reset();
  history_.back().immature.clear();
}

bool SelfCalibration::is_due(int window_keyframes) const {
  return !finished_ && params_.refine != "none" && int(history_.size()) + window_keyframes >= next_checkpoint_;
}

void SelfCalibration::forget() {
  history_.clear();
}

// Three states of knowledge besides "too early": not observed, observed and insignificant, applied. What is applied stays applied.
bool SelfCalibration::judge(double k1, double sigma, int keyframes) {
  using State = CameraRefinement::State;
  if (state_.state == State::kApplied && keyframes < state_.keyframes) return false;  // a later, shorter segment knows less
  state_.estimate = k1;
  state_.sigma = std::hypot(sigma, params_.model_sigma * kModelKeyframes / double(keyframes));
  state_.keyframes = keyframes;
  const bool observed = state_.sigma < kMaxUsefulSigma, believable = std::abs(k1) < 0.999 * params_.max_k1;
  if (state_.state == State::kApplied) return observed && believable;
  const bool significant = observed && believable && std::abs(k1) >= params_.significance * state_.sigma;
  state_.state = significant ? State::kApplied : observed ? State::kInsignificant : State::kNotObservable;
  return significant;
}

// The next checkpoint; after the last one nothing is remembered any more.
void SelfCalibration::pass_checkpoint(int keyframes, bool at_end) {
  const int last = params_.min_keyframes << (params_.checkpoints - 1);
  while (keyframes >= next_checkpoint_ && next_checkpoint_ < last) next_checkpoint_ *= 2;
  if (keyframes < last || at_end) return;
  finished_ = true;
  history_.clear();
  history_.shrink_to_fit();
}

std::optional<MapRevision> SelfCalibration::estimate(const std::vector<const Keyframe*>& window, const BaOptions& ba_options,
                                                     bool at_end) {
  if (finished_ || params_.refine == "none" || window.empty()) return std::nullopt;
  std::vector<const Keyframe*> keyframes;
  for (const Keyframe& k : history_) keyframes.push_back(&k);
  keyframes.insert(keyframes.end(), window.begin(), window.end());
  if (int(keyframes.size()) < params_.min_keyframes) return std::nullopt;

  BaOptions options = ba_options;
  options.max_iterations = 15;
  options.relative_decrease = 1e-6;
  const History history = make_history(pinhole_, state_.k1, keyframes);
  RadialEstimate e = estimate_k1(history.problem, state_.k1, params_.prior_sigma, params_.max_k1, options);
  std::optional<MapRevision> revision;
  if (e.usable && judge(e.k1, e.sigma, int(keyframes.size())) && (at_end || std::abs(e.k1 - state_.k1) > kMinChange)) {
    revision = make_revision(pinhole_, state_.k1, keyframes, history_.size(), history, ba_options, &e);
    apply_to_history(pinhole_, *revision, &history_);
    state_.k1 = e.k1;
  }
  pass_checkpoint(int(keyframes.size()), at_end);
  return revision;
}

}  // namespace edgevo
