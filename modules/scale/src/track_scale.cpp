// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/track_scale.h"

#include <algorithm>
#include <cmath>

#include "changed_interval.h"
#include "edgevo/core/order_statistics.h"
#include "track_regression.h"

namespace edgevo {
namespace {

constexpr double kMaxFrameGap_s = 0.5;  // between poses further apart the path is not a straight line
// Of an interval: a receiver jumps where houses and trees hide the sky, in one interval of twenty or fewer.
constexpr double kJumpProbability = 0.05;
constexpr double kOffsetAxes = 3;  // of an offset
// A position is compared with so many before and after it, and lies apart beyond so many times the usual
// distance: noise along one axis does once in 10^5 positions.
constexpr size_t kNeighbours = 5;
constexpr double kScattered = 7;
constexpr double kNoDistance_m = 1e-6;
// A rough scale is that of steps of a sixteenth of the path; of a path with motion.
constexpr size_t kRoughSteps = 16;
constexpr double kNoMotion = 1e-9;   // units
constexpr size_t kLargestSteps = 3;  // of the residuals, between which an interval may be displaced
// No more jumps than one for each so many positions: beyond it no noise is left to compare them with.
constexpr size_t kMinPairsPerJump = 4;

SE3 interpolate(const SE3& a, const SE3& b, double share) {
  return {a.rotation().slerp(share, b.rotation()), (1 - share) * a.translation() + share * b.translation()};
}

// Intervals between the largest steps of the residuals, and that whose mean differs most.
std::vector<IndexInterval> candidates(const Vectors& residuals) {
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

// Distance of a residual from the median of those around it (Hampel 1974): 0 along a slope, and on either
// side of a jump.
double from_median(const Vectors& residuals, size_t i) {
  const size_t first = i - std::min(i, kNeighbours), last = std::min(i + kNeighbours + 1, residuals.size());
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (size_t j = first; j < last; ++j) values.push_back(residuals[j][axis]);
    middle[axis] = median(std::move(values));
  }
  return (residuals[i] - middle).norm();
}

// Distance of a residual from the mean of its two neighbours: noise, of white residuals or of a random walk.
double from_neighbours(const Vectors& residuals, size_t i) {
  const size_t before = i > 0 ? i - 1 : i + 1, after = i + 1 < residuals.size() ? i + 1 : i - 1;
  return (residuals[i] - (residuals[before] + residuals[after]) / 2).norm();
}

// Positions that lie apart from those before and after them by more than noise. A path, and a fit that is
// wrong, change little from one to the next.
std::vector<bool> scattered(const Vectors& residuals) {
  std::vector<double> of_two, of_many;
  for (size_t i = 0; i < residuals.size(); ++i) {
    of_two.push_back(from_neighbours(residuals, i));
    of_many.push_back(from_median(residuals, i));
  }
  // Where many positions are scattered few have two good neighbours.
  const double noise = std::max(std::min(median(of_two), median(of_many)), kNoDistance_m);
  std::vector<bool> is_scattered(residuals.size());
  for (size_t i = 0; i < residuals.size(); ++i) {
    const bool is_bend = of_many[i] > 2 * of_two[i];  // 3 times, where the residuals turn back
    is_scattered[i] = std::min(of_two[i], of_many[i]) > kScattered * noise && !is_bend;
  }
  return is_scattered;
}

// What the residuals must become more probable by, in -2 ln.
double cost_of_jump(double pairs) {
  return 2 * std::log((1 - kJumpProbability) / kJumpProbability) + gain_by_chance(pairs, kOffsetAxes);
}

// One interval after another gets an offset of its own, as long as the residuals support it.
struct Grouped {
  std::vector<int> group;
  GroupedFit fit;
};
std::optional<Grouped> with_jumps(const TrackRegression& regression) {
  const size_t n = regression.size();
  Grouped best{std::vector<int>(n, 0), {}};
  std::optional<GroupedFit> first = regression.fit(best.group);
  if (!first) return std::nullopt;
  best.fit = *first;
  for (int jump = 1; size_t(jump) * kMinPairsPerJump < n; ++jump) {
    const double before = innovations(best.fit.residuals);
    std::optional<Grouped> better;
    double largest_gain = cost_of_jump(double(n));
    for (const IndexInterval& s : candidates(best.fit.residuals)) {
      std::vector<int> group = best.group;
      std::fill(group.begin() + std::ptrdiff_t(s.begin), group.begin() + std::ptrdiff_t(s.end), jump);
      std::optional<GroupedFit> fit = regression.fit(group);
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
double relative_sigma(const GroupedFit& fit) {
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

namespace {

// Some of the pairs, by their places among all.
struct Selection {
  std::vector<TrackPair> pairs;
  std::vector<size_t> places;

  Selection(const std::vector<TrackPair>& all, const std::vector<bool>& is_excluded) {
    for (size_t i = 0; i < all.size(); ++i)
      if (!is_excluded[i]) pairs.push_back(all[i]), places.push_back(i);
  }
  // Of all pairs: that of the nearest of these before a pair, or after it.
  std::vector<int> groups_before(const std::vector<int>& group, size_t count) const {
    std::vector<int> all(count);
    for (size_t i = 0, k = 0; i < count; ++i) {
      while (k + 1 < places.size() && places[k + 1] <= i) ++k;
      all[i] = group[k];
    }
    return all;
  }
  std::vector<int> groups_after(const std::vector<int>& group, size_t count) const {
    std::vector<int> all(count);
    for (size_t i = 0, k = 0; i < count; ++i) {
      while (k + 1 < places.size() && places[k] < i) ++k;
      all[i] = group[k];
    }
    return all;
  }
  std::vector<int> groups_of_these(const std::vector<int>& all) const {
    std::vector<int> group;
    for (const size_t place : places) group.push_back(all[place]);
    return group;
  }
};

// Of an absolute sensor, in a first fit: whatever is wrong with that changes little between neighbours.
std::vector<bool> scattered_at_first(const std::vector<TrackPair>& pairs, const TrackRegression& regression,
                                     PositionKind kind) {
  std::vector<bool> none(pairs.size(), false);
  if (kind == PositionKind::kIntegrated) return none;
  const auto fit = regression.fit(std::vector<int>(pairs.size(), 0));
  return fit ? scattered(fit->residuals) : none;
}

}  // namespace

std::optional<TrackFit> fit_track(const std::vector<TrackPair>& pairs, PositionKind kind,
                                  const Eigen::Vector3d& sensor_in_camera, const ScaleParams& params) {
  const std::optional<double> rough = rough_scale(pairs);
  if (!rough) return std::nullopt;
  // The sensor's position in units of the run depends on the scale.
  const TrackRegression all(pairs, sensor_in_camera, *rough);
  std::vector<bool> is_scattered = scattered_at_first(pairs, all, kind);
  const Selection first(pairs, is_scattered);
  if (first.pairs.size() < kMinTrackPairs) return std::nullopt;
  const std::optional<Grouped> found = with_jumps(TrackRegression(first.pairs, sensor_in_camera, *rough));
  if (!found) return std::nullopt;
  // Next to a jump some lay apart by what the first fit was wrong.
  std::vector<int> group = first.groups_before(found->group, pairs.size());
  const std::vector<int> group_after = first.groups_after(found->group, pairs.size());
  Vectors residuals = all.residuals(found->fit, group);
  const Vectors residuals_after = all.residuals(found->fit, group_after);
  for (size_t i = 0; i < pairs.size(); ++i)
    if (residuals_after[i].norm() < residuals[i].norm())
      residuals[i] = residuals_after[i], group[i] = group_after[i];
  const std::vector<bool> still = scattered(residuals);
  for (size_t i = 0; i < pairs.size(); ++i) is_scattered[i] = is_scattered[i] && still[i];
  const Selection kept(pairs, is_scattered);
  Grouped refined{kept.groups_of_these(group), {}};
  const auto fit = TrackRegression(kept.pairs, sensor_in_camera, found->fit.scale).fit(refined.group);
  if (!fit) return std::nullopt;
  refined.fit = *fit;
  const double sigma = relative_sigma(refined.fit);
  if (!(sigma <= params.max_sigma)) return std::nullopt;
  TrackFit track{{refined.fit.scale, sigma, int(kept.pairs.size())}, refined.fit.R, jumps_of(refined), {}};
  for (TrackJump& jump : track.jumps) jump.at = kept.places[jump.at];
  for (size_t i = 0; i < pairs.size(); ++i)
    if (is_scattered[i]) track.scattered.push_back(i);
  return track;
}

// Over steps that are long for the path, in the median: whatever a part of the positions does.
std::optional<double> rough_scale(const std::vector<TrackPair>& pairs) {
  if (pairs.size() < kMinTrackPairs) return std::nullopt;
  const size_t lag = std::max(kMinTrackPairs / 2, pairs.size() / kRoughSteps);
  std::vector<std::pair<double, double>> steps;  // of the path, of the sensor
  for (size_t i = lag; i < pairs.size(); ++i)
    steps.emplace_back((pairs[i].T_world_cam.translation() - pairs[i - lag].T_world_cam.translation()).norm(),
                       (pairs[i].position - pairs[i - lag].position).norm());
  std::sort(steps.begin(), steps.end(), std::greater<>());
  std::vector<double> ratios;
  for (size_t i = 0; 2 * i <= steps.size() && i < steps.size(); ++i)
    if (steps[i].first > kNoMotion) ratios.push_back(steps[i].second / steps[i].first);
  if (ratios.empty()) return std::nullopt;
  const double scale = median(std::move(ratios));
  return scale > 0 && std::isfinite(scale) ? std::make_optional(scale) : std::nullopt;
}

}  // namespace edgevo
