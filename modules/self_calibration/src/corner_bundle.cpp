// SPDX-License-Identifier: BSD-3-Clause
#include "corner_bundle.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "camera_problem.h"
#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr size_t kMinCorners = 30;
// A corner that slid along an edge, or lies on a body that moves, is further off than this by the median.
constexpr double kOutlier = 3;
constexpr int kRounds = 2;                // of an estimate, the next one without the outliers
constexpr double kEnoughDecrease = 1e-3;  // decrease of the cost, a share of it, that ends an adjustment
// Least inverse depth per length of the baseline, and least baseline that this is taken of.
constexpr double kMinIdepth = 1e-3, kMinBaseline = 1e-9;

struct Track {
  std::vector<std::pair<int, Eigen::Vector2d>> sights;  // view, pixel
};

// Corners that are seen in more than half of the views, by ascending id: two views show no focal length.
std::vector<Track> tracks_of(const Pinhole& pinhole, const std::vector<FeatureObservations>& views) {
  std::map<uint32_t, Track> by_id;
  for (size_t v = 0; v < views.size(); ++v)
    for (const FollowedCorner& c : views[v].corners)
      by_id[c.id].sights.emplace_back(int(v), pinhole.project(c.ray));
  std::vector<Track> tracks;
  for (auto& [id, track] : by_id)
    if (2 * track.sights.size() > views.size()) tracks.push_back(std::move(track));
  return tracks;
}

// The inverse depth whose images are nearest to the sights: linear in it, each line weighted by its depth.
double intersect(const BaProblem& p, int host, const Eigen::Vector3d& ray, const Track& track, double least) {
  double dd = 0, cd = 0;
  for (const auto& [view, px] : track.sights) {
    if (view == host) continue;
    const SE3 T = p.poses[size_t(view)].T_cam_world * p.poses[size_t(host)].T_cam_world.inverse();
    const Eigen::Vector3d a = T.rotation() * ray, b = T.translation(), m = p.pinhole.ray(px);
    const Eigen::Vector2d c = a.head<2>() - m.head<2>() * a.z(), d = b.head<2>() - m.head<2>() * b.z();
    dd += d.squaredNorm(), cd += c.dot(d);
  }
  return dd > 0 ? std::max(-cd / dd, least) : least;
}

// Hosts take turns: the host's own sight counts as exact, and so no view's errors are those of all points.
CameraProblem make_problem(const Rectification& rectification, const std::vector<FeatureObservations>& views,
                           const std::vector<Track>& tracks) {
  CameraProblem problem;
  problem.rectification = rectification;
  BaProblem& p = problem.file;
  p.pinhole = rectification.target();
  for (size_t v = 0; v < views.size(); ++v) {
    p.poses.push_back({views[v].T_cam_path, v == 0});
    p.pose_ids.push_back(int(v));
  }
  const SE3 &first = views.front().T_cam_path, &last = views.back().T_cam_path;
  p.prior = ba::fix_baseline(first, last, int(views.size()) - 1);
  const double baseline = (last * first.inverse()).translation().norm();
  const double least = kMinIdepth / std::max(baseline, kMinBaseline);
  for (size_t i = 0; i < tracks.size(); ++i) {
    const Track& track = tracks[i];
    const auto& [host, px_host] = track.sights[i % track.sights.size()];
    BaPoint point;
    point.host = host;
    point.ray = p.pinhole.ray(px_host);
    point.idepth = intersect(p, host, point.ray, track, least);
    p.points.push_back(point);
    problem.px_host.push_back(px_host);
    for (const auto& [view, px] : track.sights)
      if (view != host)
        p.observations.push_back({int(i), view, px, {1, 0}, 1 / kFollowedSigmaPx, 1 / kFollowedSigmaPx});
  }
  return problem;
}

// RMS distance of each track from its point, pixels.
std::vector<double> misses(const BaProblem& p) {
  std::vector<double> square(p.points.size(), 0), count(p.points.size(), 0);
  for (const BaObservation& o : p.observations) {
    const BaPoint& point = p.points[size_t(o.point)];
    const SE3 T = p.poses[size_t(o.target)].T_cam_world * p.poses[size_t(point.host)].T_cam_world.inverse();
    const Eigen::Vector3d Y = T.rotation() * point.ray + point.idepth * T.translation();
    square[size_t(o.point)] += (p.pinhole.project(Y) - o.px).squaredNorm(), count[size_t(o.point)] += 1;
  }
  for (size_t i = 0; i < square.size(); ++i) square[i] = std::sqrt(square[i] / count[i]);
  return square;
}

std::vector<Track> without_outliers(const std::vector<Track>& tracks, const std::vector<double>& miss) {
  const double most = kOutlier * median(miss);
  std::vector<Track> kept;
  for (size_t i = 0; i < tracks.size(); ++i)
    if (miss[i] < most) kept.push_back(tracks[i]);
  return kept;
}

// A distortion that the file lacks looks like a longer focal length in a turn: it is free, near what is
// known.
CameraSearch search_from(const CameraError& start, double k1) {
  CameraSearch search;
  search.start = start;
  search.free = only({kFocal, kK1});
  search.prior[kK1] = k1;
  return search;
}

}  // namespace

std::optional<FocalError> adjust_corners(const Rectification& rectification,
                                         const std::vector<FeatureObservations>& views,
                                         const ImageCorrection& lens) {
  BaOptions options;
  options.relative_decrease = kEnoughDecrease;
  CameraError error;
  error.correction.k1 = lens.k1, error.correction.focal = lens.focal;
  std::vector<FeatureObservations> placed = views;
  std::vector<Track> tracks = tracks_of(rectification.target(), views);
  CameraEstimate found;
  for (int round = 0; round < kRounds; ++round) {
    if (tracks.size() < kMinCorners) return std::nullopt;
    const CameraProblem problem = make_problem(rectification, placed, tracks);
    found = estimate_camera(problem, search_from(error, lens.k1), options);
    if (!found.usable) return std::nullopt;
    error = found.value;
    for (size_t v = 0; v < placed.size(); ++v) placed[v].T_cam_path = found.solution.poses[v].T_cam_world;
    tracks = without_outliers(tracks, misses(found.solution));
  }
  const double sigma = found.sigma[kFocal];
  if (!(sigma > 0) || !std::isfinite(sigma)) return std::nullopt;
  return FocalError{error.correction.focal, sigma, 1};
}

}  // namespace edgevo
