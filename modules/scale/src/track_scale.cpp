// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/track_scale.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "changed_interval.h"

namespace edgevo {
namespace {

constexpr double kMaxFrameGap_s = 0.5;  // between poses further apart the path is not a straight line
constexpr double kNoLength = 1e-12;     // metres: added to residuals, where all are 0 none is displaced
constexpr double kNoSpread = 1e-9;      // units or metres: positions that are all the same fit any scale
// Of an interval: a receiver jumps where houses and trees hide the sky, in one interval of twenty or fewer.
constexpr double kJumpProbability = 0.05;
// Of a step of the camera between two positions, relative: KITTI's are wrong by up to a tenth where a map is
// young or the view turns. Three of it are no jump of the sensor.
constexpr double kStepSigma = 0.1, kStepSigmas = 3;
constexpr double kMotionAxes = 2;    // of the residuals: a vehicle moves in a plane
constexpr double kOffsetAxes = 3;    // of an offset
constexpr size_t kLargestSteps = 3;  // of the residuals, between which an interval may be displaced
// No more jumps than one for each so many positions: beyond it no noise is left to compare them with.
constexpr size_t kMinPairsPerJump = 4;

SE3 interpolate(const SE3& a, const SE3& b, double share) {
  return {a.rotation().slerp(share, b.rotation()), (1 - share) * a.translation() + share * b.translation()};
}

using Points = std::vector<Eigen::Vector3d>;

// target ~ scale R source + offset of the group.
struct Fit {
  double scale = 0;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  double spread = 0;  // summed squares of the sources about the means of their groups
  Points offsets;     // of the groups
  Points residuals;   // of the pairs
  Points arms;        // R (source - mean of its group)
};

class Regression {
 public:
  Regression(const std::vector<TrackPair>& pairs, const Eigen::Vector3d& sensor_in_camera, double scale) {
    for (const TrackPair& pair : pairs) {
      source_.push_back(pair.T_world_cam.translation());
      if (scale > 0) source_.back() += pair.T_world_cam.R() * sensor_in_camera / scale;
      target_.push_back(pair.position);
    }
  }
  size_t size() const { return source_.size(); }

  // `group` of each pair, from 0 on.
  std::optional<Fit> fit(const std::vector<int>& group) const {
    const int groups = 1 + *std::max_element(group.begin(), group.end());
    const Points source_means = means(source_, group, groups), target_means = means(target_, group, groups);
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    double source_squares = 0, target_squares = 0;
    for (size_t i = 0; i < size(); ++i) {
      const Eigen::Vector3d s = source_[i] - source_means[size_t(group[i])],
                            t = target_[i] - target_means[size_t(group[i])];
      products += t * s.transpose();
      source_squares += s.squaredNorm(), target_squares += t.squaredNorm();
    }
    if (!(std::sqrt(source_squares) > kNoSpread) || !(std::sqrt(target_squares) > kNoSpread))
      return std::nullopt;
    Fit fit;
    fit.spread = source_squares;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1;
    fit.R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    fit.scale = svd.singularValues().dot(signs) / source_squares;
    if (!(fit.scale > 0) || !std::isfinite(fit.scale)) return std::nullopt;
    for (int g = 0; g < groups; ++g)
      fit.offsets.push_back(target_means[size_t(g)] - fit.scale * (fit.R * source_means[size_t(g)]));
    for (size_t i = 0; i < size(); ++i) {
      fit.arms.push_back(fit.R * (source_[i] - source_means[size_t(group[i])]));
      fit.residuals.push_back(target_[i] - target_means[size_t(group[i])] - fit.scale * fit.arms.back());
    }
    return fit;
  }

  // Whether each jump is more than an error of the camera's own step there.
  bool is_beyond_steps(const Fit& fit, const std::vector<int>& group) const {
    for (size_t i = 1; i < size(); ++i) {
      if (group[i] == group[i - 1]) continue;
      const double step = fit.scale * (source_[i] - source_[i - 1]).norm();
      const double jump = (fit.offsets[size_t(group[i])] - fit.offsets[size_t(group[i - 1])]).norm();
      if (jump < kStepSigmas * kStepSigma * step) return false;
    }
    return true;
  }

 private:
  static Points means(const Points& points, const std::vector<int>& group, int groups) {
    Points sums(size_t(groups), Eigen::Vector3d::Zero());
    std::vector<double> counts(size_t(groups), 0.0);
    for (size_t i = 0; i < points.size(); ++i)
      sums[size_t(group[i])] += points[i], ++counts[size_t(group[i])];
    for (size_t g = 0; g < sums.size(); ++g)
      if (counts[g] > 0) sums[g] /= counts[g];
    return sums;
  }

  Points source_, target_;
};

// Sum of the squared innovations of residuals as an autoregressive process of first order.
double innovations(const Points& residuals) {
  double squares = 0, products = 0;
  for (size_t i = 0; i < residuals.size(); ++i) {
    squares += residuals[i].squaredNorm();
    if (i > 0) products += residuals[i].dot(residuals[i - 1]);
  }
  const double rho = squares > 0 ? std::clamp(products / squares, 0.0, 1.0) : 0.0;
  double sum = residuals.front().squaredNorm() * (1 - rho * rho);
  for (size_t i = 1; i < residuals.size(); ++i) sum += (residuals[i] - rho * residuals[i - 1]).squaredNorm();
  return sum + double(residuals.size()) * kNoLength * kNoLength;
}

// Intervals between the largest steps of the residuals, and that whose mean differs most.
std::vector<IndexInterval> candidates(const Points& residuals) {
  std::vector<std::pair<double, size_t>> steps;
  for (size_t i = 1; i < residuals.size(); ++i)
    steps.emplace_back((residuals[i] - residuals[i - 1]).squaredNorm(), i);
  const size_t kept = std::min(kLargestSteps, steps.size());
  std::partial_sort(steps.begin(), steps.begin() + std::ptrdiff_t(kept), steps.end(), std::greater<>());
  std::vector<size_t> places{0, residuals.size()};
  for (size_t k = 0; k < kept; ++k) places.push_back(steps[k].second);
  std::sort(places.begin(), places.end());
  std::vector<IndexInterval> intervals{changed_interval(residuals)};
  for (size_t a = 0; a < places.size(); ++a)
    for (size_t b = a + 1; b < places.size(); ++b)
      if (b - a + 1 < places.size()) intervals.push_back({places[a], places[b]});
  return intervals;
}

// What the residuals must become more probable by, in -2 ln.
double cost_of_jump(double pairs) {
  return 2 * std::log((1 - kJumpProbability) / kJumpProbability) + gain_by_chance(pairs, kOffsetAxes);
}

// One interval after another gets an offset of its own, as long as the residuals support it.
struct Grouped {
  std::vector<int> group;
  Fit fit;
};
std::optional<Grouped> with_jumps(const Regression& regression) {
  const size_t n = regression.size();
  Grouped best{std::vector<int>(n, 0), {}};
  std::optional<Fit> first = regression.fit(best.group);
  if (!first) return std::nullopt;
  best.fit = *first;
  for (int jump = 1; size_t(jump) * kMinPairsPerJump < n; ++jump) {
    const double before = innovations(best.fit.residuals);
    std::optional<Grouped> better;
    double largest_gain = cost_of_jump(double(n));
    for (const IndexInterval& s : candidates(best.fit.residuals)) {
      std::vector<int> group = best.group;
      std::fill(group.begin() + std::ptrdiff_t(s.begin), group.begin() + std::ptrdiff_t(s.end), jump);
      std::optional<Fit> fit = regression.fit(group);
      if (!fit) continue;
      if (!regression.is_beyond_steps(*fit, group)) continue;
      const double gain = kMotionAxes * double(n) * std::log(before / innovations(fit->residuals));
      if (gain > largest_gain) largest_gain = gain, better = {std::move(group), std::move(*fit)};
    }
    if (!better) break;
    best = std::move(*better);
  }
  return best;
}

std::vector<TrackJump> jumps_of(const Grouped& found) {
  std::vector<TrackJump> jumps;
  for (size_t i = 1; i < found.group.size(); ++i)
    if (found.group[i] != found.group[i - 1])
      jumps.push_back(
          {i, found.fit.offsets[size_t(found.group[i])] - found.fit.offsets[size_t(found.group[i - 1])]});
  return jumps;
}

// That of a regression's slope, with what successive residuals have in common.
double relative_sigma(const Fit& fit) {
  std::vector<double> moments;
  double squares = 0;
  for (size_t i = 0; i < fit.residuals.size(); ++i) {
    moments.push_back(fit.residuals[i].dot(fit.arms[i]));
    squares += moments.back() * moments.back();
  }
  const double n = double(moments.size());
  return std::sqrt(squares * n / effective_count(moments)) / fit.spread / fit.scale;
}

}  // namespace

std::vector<TrackPair> pair_up(const Path& path, const VehicleTrack& track) {
  std::vector<TrackPair> pairs;
  size_t next = 1;  // first pose not before the position
  if (path.empty()) return pairs;
  const auto first = std::lower_bound(track.positions.begin(), track.positions.end(), path.front().time,
                                      [](const VehiclePosition& p, Timestamp t) { return p.time < t; });
  for (auto at = first; at != track.positions.end(); ++at) {
    const VehiclePosition& p = *at;
    while (next < path.size() && path[next].time < p.time) ++next;
    if (next >= path.size()) break;
    const PathPose &a = path[next - 1], &b = path[next];
    const double gap = seconds_between(a.time, b.time), since = seconds_between(a.time, p.time);
    if (since < 0 || !(gap > 0) || gap > kMaxFrameGap_s) continue;
    const double share = since / gap;
    pairs.push_back({(1 - share) * a.distance + share * b.distance, share > 0 ? b.frame_index : a.frame_index,
                     interpolate(a.T_world_cam, b.T_world_cam, share), p.position});
  }
  return pairs;
}

std::optional<TrackFit> fit_track(const std::vector<TrackPair>& pairs,
                                  const Eigen::Vector3d& sensor_in_camera, const ScaleParams& params) {
  if (pairs.size() < kMinTrackPairs) return std::nullopt;
  const std::optional<double> rough = rough_scale(pairs);
  if (!rough) return std::nullopt;
  // The sensor's position in units of the run depends on the scale.
  std::optional<Grouped> found = with_jumps(Regression(pairs, sensor_in_camera, *rough));
  if (!found) return std::nullopt;
  const auto refined = Regression(pairs, sensor_in_camera, found->fit.scale).fit(found->group);
  if (!refined) return std::nullopt;
  found->fit = *refined;
  const double sigma = relative_sigma(found->fit);
  if (!(sigma <= params.max_sigma)) return std::nullopt;
  return TrackFit{{found->fit.scale, sigma, int(pairs.size())}, found->fit.R, jumps_of(*found)};
}

std::optional<double> rough_scale(const std::vector<TrackPair>& pairs) {
  if (pairs.size() < kMinTrackPairs) return std::nullopt;
  const auto fit = Regression(pairs, Eigen::Vector3d::Zero(), 0).fit(std::vector<int>(pairs.size(), 0));
  return fit ? std::make_optional(fit->scale) : std::nullopt;
}

}  // namespace edgevo
