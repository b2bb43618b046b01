#include "edgevo/mapping/window.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "edgevo/alignment/projection.h"
#include "edgevo/association/look_ahead.h"
#include "edgevo/association/patch_source.h"
#include "edgevo/association/photometric_residual.h"
#include "edgevo/association/uncertainty.h"
#include "edgevo/association/warp.h"
#include "edgevo/mapping/depth_filter.h"

namespace edgevo {
namespace {

constexpr int kMaxMisses = 3;       // a point that more keyframes than this should have seen is dropped
constexpr double kDropSigmas = 4.0; // observations beyond this after the last adjustment are dropped
constexpr double kViewBorderPx = 6;
constexpr double kEnoughDecrease = 1e-3;  // share of the cost; what is left after it is below the noise of the matches

bool in_view(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector2d& px_host, double idepth,
             Eigen::Vector2d* px) {
  const Projection p = project(camera, T_target_host.R(), T_target_host.translation(), camera.ray(px_host), idepth);
  if (!p.valid || !camera.contains(p.px, kViewBorderPx)) return false;
  *px = p.px;
  return true;
}

// The part of a problem that concerns the points of one host.
BaProblem problem_of_host(BaProblem all, int host) {
  BaProblem part = all;
  part.points.clear();
  part.observations.clear();
  std::vector<int> index(all.points.size(), -1);
  for (size_t i = 0; i < all.points.size(); ++i)
    if (all.points[i].host == host) {
      index[i] = int(part.points.size());
      part.points.push_back(all.points[i]);
    }
  for (BaObservation o : all.observations)
    if (index[o.point] >= 0) {
      o.point = index[o.point];
      part.observations.push_back(o);
    }
  return part;
}

// Covariance of a window pose against another one after an adjustment: small beside the tracking covariance.
Matrix6d settled_covariance() { return 1e-8 * Matrix6d::Identity(); }

}  // namespace

Window::Window(const Pinhole& pinhole, const WindowParams& params, const AssociationParams& association)
    : pinhole_(pinhole), params_(params), association_(association), adjuster_(make_bundle_adjuster(params.solver)) {}

int Window::active_points() const {
  int n = 0;
  for (const Keyframe& k : keyframes_) n += int(k.points.size());
  return n;
}

std::vector<Window::View> Window::views_from(const Keyframe& host) const {
  std::vector<View> views;
  for (const Keyframe& target : keyframes_)
    if (target.id != host.id) views.push_back({&target, relative_pose(target, host)});
  return views;
}

AssociationQuery Window::query(const Keyframe& host, const MapPoint& point, const View& view) const {
  AssociationQuery q;
  q.host = host.pyramid.get();
  q.target = view.target->pyramid.get();
  q.px_host = point.px;
  q.normal_host = point.normal;
  q.idepth = point.idepth;
  q.idepth_sigma = point.idepth_sigma;
  q.T_target_host = view.T_target_host;
  q.pose_covariance = settled_covariance();
  return q;
}

int Window::associate_newest(const Matrix6d& pose_covariance) {
  int matches = 0;
  const Keyframe& target = newest();
  for (Keyframe& host : keyframes_) {
    if (host.id == target.id) continue;
    const View view{&target, relative_pose(target, host)};
    for (MapPoint& point : host.points) {
      Eigen::Vector2d px;
      if (!in_view(pinhole_, view.T_target_host, point.px, point.idepth, &px)) continue;
      AssociationQuery q = query(host, point, view);
      q.pose_covariance = pose_covariance;
      const Match match = associate(q, association_);
      if (match.kind == MatchKind::kNone) {
        ++point.misses;
        continue;
      }
      point.observations.push_back({target.id, match});
      ++matches;
    }
  }
  return matches;
}

std::vector<Window::Sight> Window::in_sight(const ImmaturePoint& candidate, const std::vector<View>& views) const {
  std::vector<Sight> sights;
  Eigen::Vector2d px;
  for (const View& view : views)
    if (in_view(pinhole_, view.T_target_host, candidate.px, candidate.idepth, &px)) sights.push_back({&view, px});
  return sights;
}

bool Window::try_activate(const ImmaturePoint& candidate, const std::vector<Sight>& sights, int min_matches, Keyframe* host) const {
  MapPoint point;
  point.px = candidate.px;
  point.normal = candidate.normal;
  point.idepth = candidate.idepth;
  point.idepth_sigma = candidate.idepth_sigma;
  point.edge_pixel = candidate.edge_pixel;
  LookAhead look_ahead(association_);
  for (const Sight& s : sights) look_ahead.add(*s.view->target->pyramid, s.px);
  look_ahead.run();
  for (const Sight& s : sights) {
    const Match match = associate(query(*host, point, *s.view), association_);
    if (match.kind != MatchKind::kNone) point.observations.push_back({s.view->target->id, match});
  }
  if (int(point.observations.size()) < min_matches) return false;
  host->points.push_back(std::move(point));
  return true;
}

int Window::activate(int min_good, int min_matches) {
  const CellGrid grid(pinhole_.width, pinhole_.height, params_.activation_cell_px);
  std::vector<int> count(grid.size(), 0);
  int active = 0;
  Eigen::Vector2d px;
  for (const Keyframe& host : keyframes_) {
    const SE3 T = relative_pose(newest(), host);
    for (const MapPoint& p : host.points) {
      ++active;
      if (host.id == newest().id)
        ++count[grid.index(p.px.x(), p.px.y())];
      else if (in_view(pinhole_, T, p.px, p.idepth, &px))
        ++count[grid.index(px.x(), px.y())];
    }
  }
  int activated = 0;
  // First one point a cell, then two: the newest hosts first, they will be seen longest.
  for (int per_cell = 1; per_cell <= 2; ++per_cell)
    for (auto host = keyframes_.rbegin(); host != keyframes_.rend(); ++host) {
      const SE3 T = relative_pose(newest(), *host);
      const std::vector<View> views = views_from(*host);
      for (ImmaturePoint& p : host->immature) {
        if (active >= params_.max_points) return activated;
        if (p.dead || p.good < min_good) continue;
        if (!in_view(pinhole_, T, p.px, p.idepth, &px)) continue;
        int& here = count[grid.index(px.x(), px.y())];
        if (here >= per_cell) continue;
        const SE3& T_view = host->id == newest().id ? relative_pose(keyframes_[keyframes_.size() - 2], *host) : T;
        const DepthMotion motion = depth_motion(pinhole_, T_view, pinhole_.ray(p.px), p.idepth, p.idepth_sigma);
        if (motion.sigma_mu_px > params_.max_projected_sigma_px) continue;
        const std::vector<Sight> sights = in_sight(p, views);
        if (int(sights.size()) < min_matches) continue;  // new in view, as the border is when the camera backs away: it waits
        p.dead = true;  // tried once: it becomes active or is gone
        if (!try_activate(p, sights, min_matches, &*host)) continue;
        ++here, ++active, ++activated;
      }
    }
  return activated;
}

Window::Adjustment Window::build_adjustment() {
  Adjustment a;
  BaProblem& problem = a.problem;
  problem.pinhole = pinhole_;
  for (const Keyframe& k : keyframes_) {
    problem.poses.push_back({k.T_cam_world, false});
    problem.pose_ids.push_back(k.id);
  }
  const auto pose_index = [&](int id) {
    const auto it = std::lower_bound(problem.pose_ids.begin(), problem.pose_ids.end(), id);
    return int(it - problem.pose_ids.begin());
  };
  size_t matches = 0;
  for (const Keyframe& k : keyframes_)
    for (const MapPoint& p : k.points) matches += p.observations.size();
  problem.observations.reserve(matches), a.match_index.reserve(matches);
  problem.points.reserve(active_points()), a.points.reserve(active_points());
  for (size_t h = 0; h < keyframes_.size(); ++h)
    for (MapPoint& p : keyframes_[h].points) {
      if (p.observations.empty()) continue;
      bool fixed = true;
      for (const Observation& o : p.observations) {
        fixed = fixed && o.match.kind == MatchKind::kEdgeFixed;
        const int target = pose_index(o.keyframe_id);
        a.match_index.push_back(int(problem.observations.size()));
        problem.observations.push_back({int(problem.points.size()), target, o.match.px, o.match.normal,
                                        o.match.inv_sigma_normal, o.match.inv_sigma_tangent});
        if (params_.photometric) add_photometric(keyframes_[h], p, target, &problem);
      }
      problem.points.push_back({int(h), pinhole_.ray(p.px), p.idepth, fixed});
      a.points.push_back(&p);
    }
  add_corners(&problem);
  apply_gauge(&problem);
  return a;
}

void Window::add_corners(BaProblem* problem) const {
  for (size_t to = 0; to < keyframes_.size(); ++to) {
    const auto from = std::find(problem->pose_ids.begin(), problem->pose_ids.end(), keyframes_[to].corners_from);
    if (from == problem->pose_ids.end()) continue;  // it has left the window, and taken what they say into the prior
    for (const CornerPair& c : keyframes_[to].corners)
      problem->corners.push_back({int(from - problem->pose_ids.begin()), int(to), c.from, c.to, 1 / params_.corner_sigma_px});
  }
}

// Eq. (photometricerror), linearised at the present projection, as a residual in the principal axes of its information.
void Window::add_photometric(const Keyframe& host, const MapPoint& point, int target_index,
                             BaProblem* problem) const {
  const Keyframe& target = keyframes_[target_index];
  const SE3 T_target_host = relative_pose(target, host);
  Eigen::Vector2d px;
  if (!in_view(pinhole_, T_target_host, point.px, point.idepth, &px)) return;
  const PatchSource from = patch_source(*host.pyramid, point.px, patch_warp(pinhole_, T_target_host, point.px, point.idepth));
  const PhotometricResidual r = photometric_residual(from.level->gradient_magnitude.view(), from.px, from.A_target_host,
                                                     target.pyramid->finest().gradient_magnitude.view(), px);
  if (!r.usable) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(r.information);
  BaObservation o;
  o.point = int(problem->points.size());
  o.target = target_index;
  o.px = px + r.shift;
  o.normal = axes.eigenvectors().col(1);  // the axis along which the patch changes most
  o.inv_sigma_normal = std::sqrt(axes.eigenvalues()[1]) / params_.photometric_sigma;
  o.inv_sigma_tangent = std::sqrt(std::max(0.0, axes.eigenvalues()[0])) / params_.photometric_sigma;
  problem->observations.push_back(o);
}

void Window::apply_gauge(BaProblem* problem) const {
  if (problem->poses.empty()) return;
  problem->prior = prior_;
  const bool marginalised = prior_ && !bootstrap_gauge_;
  if (marginalised) return;  // the prior holds position, rotation and scale
  problem->poses[0].fixed = true;
  if (!bootstrap_gauge_ && problem->poses.size() > 2) problem->poses[1].fixed = true;
}

void Window::hold_bootstrap_scale() {
  if (keyframes_.size() < 2) return;
  const SE3& T_cam_world = newest().T_cam_world;
  const SE3 T_1_0 = relative_pose(newest(), keyframes_.front());
  // Moving the last camera along the baseline changes its translation by b = t / |t|: held to 1e-4 of the baseline.
  BaPrior prior;
  prior.pose_ids = {newest().id};
  prior.linearization = {T_cam_world};
  const Eigen::Vector3d baseline = T_1_0.translation();
  const double sigma = 1e-4 * baseline.norm();
  prior.H = Eigen::MatrixXd::Zero(6, 6);
  prior.H.topLeftCorner<3, 3>() = baseline.normalized() * baseline.normalized().transpose() / (sigma * sigma);
  prior.b = Eigen::VectorXd::Zero(6);
  prior_ = prior;
  bootstrap_gauge_ = true;
}

void Window::take_result(const BaResult& result, const Adjustment& a) {
  for (size_t i = 0; i < keyframes_.size(); ++i) keyframes_[i].T_cam_world = a.problem.poses[i].T_cam_world;
  for (size_t i = 0; i < a.points.size(); ++i) {
    a.points[i]->idepth = a.problem.points[i].idepth;
    if (result.idepth_sigma[i] > 0) a.points[i]->idepth_sigma = result.idepth_sigma[i];
  }
}

int Window::update_matches(const BaResult& result, const Adjustment& adjustment) {
  int updated = 0;
  size_t k = 0;  // matches stand in the order of build_adjustment
  const std::vector<MapPoint*>& points = adjustment.points;
  size_t next = 0;
  for (Keyframe& host : keyframes_) {
    const std::vector<View> views = views_from(host);
    for (MapPoint& p : host.points) {
      if (next >= points.size() || points[next] != &p) continue;
      ++next;
      size_t kept = 0;
      for (Observation& o : p.observations) {
        const int index = adjustment.match_index[k++];
        if (needs_update(o.match, result.residual_normal_px[index], result.residual_tangent_px[index], association_)) {
          ++updated;
          const auto view = std::find_if(views.begin(), views.end(), [&](const View& v) { return v.target->id == o.keyframe_id; });
          o.match = associate(query(host, p, *view), association_);
        }
        if (o.match.kind != MatchKind::kNone) p.observations[kept++] = o;
      }
      p.observations.resize(kept);
    }
  }
  return updated;
}

void Window::drop_unfit(const BaResult& result, const Adjustment& adjustment) {
  size_t k = 0;
  for (MapPoint* p : adjustment.points) {
    size_t kept = 0;
    for (const Observation& o : p->observations) {
      const double sigmas = std::abs(result.residual_normal_px[adjustment.match_index[k++]]) * o.match.inv_sigma_normal;
      if (sigmas < kDropSigmas)
        p->observations[kept++] = o;
      else
        ++p->misses;
    }
    p->observations.resize(kept);
  }
  for (Keyframe& host : keyframes_) {
    auto gone = std::remove_if(host.points.begin(), host.points.end(), [](const MapPoint& p) {
      return p.observations.empty() || p.misses > kMaxMisses || !(p.idepth > 0);
    });
    host.points.erase(gone, host.points.end());
  }
}

WindowStats Window::adjust() {
  WindowStats stats;
  BaOptions options;
  options.huber_width = params_.ba_huber;
  options.max_iterations = params_.ba_iterations;
  options.relative_decrease = kEnoughDecrease;
  Adjustment adjustment = build_adjustment();
  BaResult result = adjuster_->solve(&adjustment.problem, options);
  if (!result.usable) return stats;
  take_result(result, adjustment);
  if (params_.ba_update_iterations > 0) {
    stats.updated_matches = update_matches(result, adjustment);
    options.max_iterations = params_.ba_update_iterations;
    adjustment = build_adjustment();
    result = adjuster_->solve(&adjustment.problem, options);
    if (!result.usable) return stats;
    take_result(result, adjustment);
  }
  const BaProblem& problem = adjustment.problem;
  stats.observations = int(problem.observations.size());
  stats.points = int(problem.points.size());
  stats.cost_per_observation = result.final_cost / std::max(1, stats.observations);
  for (const BaPoint& p : problem.points) stats.fixed_depth += p.fixed;
  for (const BaObservation& o : problem.observations) {
    stats.photometric += o.inv_sigma_tangent > 0;
    stats.matched_in_newest += o.target + 1 == int(keyframes_.size());
  }
  drop_unfit(result, adjustment);
  return stats;
}

Keyframe Window::remove_oldest() {
  const int id = keyframes_.front().id;
  if (params_.gauge == "prior") {
    // Only the points it hosts go into the prior with it. Points of other hosts lose their observation here and live on: their
    // other observations stay in the window and must not be counted twice.
    const BaProblem problem = problem_of_host(build_adjustment().problem, 0);
    BaOptions options;
    options.huber_width = params_.ba_huber;
    std::vector<bool> drop;
    prior_ = marginalize(problem, id, options, &drop);
  } else {
    prior_.reset();
  }
  bootstrap_gauge_ = false;
  Keyframe oldest = std::move(keyframes_.front());
  keyframes_.pop_front();
  for (Keyframe& host : keyframes_) {
    for (MapPoint& p : host.points)
      p.observations.erase(std::remove_if(p.observations.begin(), p.observations.end(),
                                          [&](const Observation& o) { return o.keyframe_id == id; }),
                           p.observations.end());
    host.points.erase(std::remove_if(host.points.begin(), host.points.end(),
                                     [](const MapPoint& p) { return p.observations.empty(); }),
                      host.points.end());
  }
  return oldest;
}

}  // namespace edgevo
