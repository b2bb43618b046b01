// SPDX-License-Identifier: BSD-3-Clause
#include "clock_offset.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "changed_interval.h"
#include "track_regression.h"

namespace edgevo {
namespace {

// Seconds. Buffers and drivers delay by fractions of one; beyond two, paths that repeat fit as well. A
// vehicle turns and brakes within a second.
constexpr double kMaxOffset_s = 2, kCoarseStep_s = 0.1, kFineStep_s = 0.01;
constexpr double kPlaceSigma_m = 1;     // of a sensor on its vehicle
constexpr size_t kMaxPositions = 4000;  // of a track, evenly taken: the cost is linear
constexpr double kCertainSigmas = 3;    // that the offset is none
constexpr double kFitted = 7;           // a similarity
constexpr int kPlaceIterations = 2;
// The path is cut into five parts at least; what the best fifth of the parts says does not count: where a
// slip begins and ends, other times fit better by accident.
constexpr int kMinParts = 5;

constexpr double kNever = std::numeric_limits<double>::infinity();

VehicleTrack thinned(const VehicleTrack& track) {
  VehicleTrack rest = track;
  const size_t every = track.positions.size() / kMaxPositions + 1;
  rest.positions.clear();
  for (size_t i = 0; i < track.positions.size(); i += every) rest.positions.push_back(track.positions[i]);
  return rest;
}

using Part = std::pair<size_t, int>;  // path, part of it

// The innovations of an interval's residuals, and what they would be with the sensor displaced by l in the
// camera's axes: a residual then falls by R (R_i - mean R) l.
struct Interval {
  double positions = 0, squares = 0;
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();

  Interval(const GroupedFit& fit, const std::vector<TrackPair>& pairs)
      : positions(double(pairs.size())), squares(innovations(fit.residuals)) {
    const double rho = autocorrelation(fit.residuals);
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
    for (const TrackPair& pair : pairs) mean += pair.T_world_cam.R() / positions;
    // Columns: rotation and scale of the similarity, which adapt to l; l.
    using Columns = Eigen::Matrix<double, 3, 7>;
    Eigen::Matrix<double, 7, 7> products = Eigen::Matrix<double, 7, 7>::Zero();
    Eigen::Matrix<double, 7, 1> with_residuals = Eigen::Matrix<double, 7, 1>::Zero();
    Columns before;
    for (size_t i = 0; i < pairs.size(); ++i) {
      Columns columns;
      columns << skew(fit.arms[i]), fit.arms[i], fit.R * (pairs[i].T_world_cam.R() - mean);
      if (i > 0) {
        const Columns change = columns - rho * before;
        products += change.transpose() * change;
        with_residuals += change.transpose() * (fit.residuals[i] - rho * fit.residuals[i - 1]);
      }
      before = columns;
    }
    const Eigen::Matrix<double, 3, 4> adapts =
        products.bottomLeftCorner<3, 4>() *
        products.topLeftCorner<4, 4>().completeOrthogonalDecomposition().pseudoInverse();
    information = products.bottomRightCorner<3, 3>() - adapts * products.topRightCorner<4, 3>();
    moments = with_residuals.tail<3>() - adapts * with_residuals.head<4>();
  }
  double variance() const { return squares / (kMotionAxes * positions - kFitted); }
};

// The most probable place of the sensor, from where the intervals take it to be; `stated` is its prior.
Eigen::Vector3d best_place(const std::map<Part, Interval>& intervals, const Eigen::Vector3d& place,
                           const Eigen::Vector3d& stated) {
  constexpr double kPrior = 1 / (kPlaceSigma_m * kPlaceSigma_m);
  Eigen::Matrix3d information = kPrior * Eigen::Matrix3d::Identity();
  Eigen::Vector3d moments = kPrior * (stated - place);
  for (const auto& [part, i] : intervals)
    information += i.information / i.variance(), moments += i.moments / i.variance();
  return place + information.ldlt().solve(moments);
}

class ClockFit {
 public:
  ClockFit(const std::vector<const Path*>& paths, const VehicleTrack& track,
           const Eigen::Vector3d& sensor_in_camera, const ScaleParams& params)
      : paths_(paths), track_(track), sensor_in_camera_(sensor_in_camera), params_(params) {}

  // -2 ln of the probability of the residuals: of all, for as many positions as at the first offset; and by
  // part.
  struct Cost {
    double all = kNever;
    std::map<Part, double> of_part;
  };
  Cost cost(double late_s) {
    const VehicleTrack track = corrected(track_, late_s);
    std::vector<std::vector<TrackPair>> pairs;
    for (const Path* path : paths_) pairs.push_back(pair_up(*path, track));
    if (scale_.empty())
      for (size_t i = 0; i < paths_.size(); ++i) begin_path(i, pairs[i]);
    Eigen::Vector3d place = sensor_in_camera_;
    std::map<Part, Interval> intervals = intervals_of(pairs, place);
    for (int iteration = 0; iteration < kPlaceIterations; ++iteration) {
      place = best_place(intervals, place, sensor_in_camera_);
      intervals = intervals_of(pairs, place);
    }
    double count = 0;
    for (const auto& [part, i] : intervals) count += i.positions;
    if (positions_ == 0) positions_ = count;
    // Of few positions within the path the shape is no evidence.
    if (!(count > 0) || 2 * count < positions_) return {};
    Cost cost{(place - sensor_in_camera_).squaredNorm() / (kPlaceSigma_m * kPlaceSigma_m), {}};
    for (const auto& [part, i] : intervals) {
      cost.of_part[part] = kMotionAxes * i.positions * std::log(i.variance());
      cost.all += cost.of_part[part] * positions_ / count;
    }
    return cost;
  }
  double positions() const { return positions_; }

 private:
  // As many parts as intervals, as long as each can have twice the least number of positions.
  void begin_path(size_t path, const std::vector<TrackPair>& pairs) {
    scale_.push_back(rough_scale(pairs));
    const double intervals = paths_[path]->back().distance * scale_.back().value_or(0) / params_.interval;
    const double most = double(pairs.size()) / (2 * double(kMinTrackPairs));
    parts_.push_back(std::max(kMinParts, int(std::min(intervals, most))));
  }
  // The paths in equal parts, the same ones for all offsets, with the sensor at a place in the camera's axes.
  std::map<Part, Interval> intervals_of(const std::vector<std::vector<TrackPair>>& pairs,
                                        const Eigen::Vector3d& place) const {
    std::map<Part, Interval> intervals;
    for (size_t path = 0; path < paths_.size(); ++path) {
      if (!scale_[path]) continue;
      const double length = paths_[path]->back().distance;
      const int parts = parts_[path];
      auto begin = pairs[path].begin();
      for (int part = 1; part <= parts; ++part) {
        const auto end = std::partition_point(begin, pairs[path].end(), [&](const TrackPair& pair) {
          return part == parts || pair.distance < part * length / parts;
        });
        if (const auto interval = interval_of({begin, end}, place, *scale_[path]))
          intervals.emplace(Part{path, part}, *interval);
        begin = end;
      }
    }
    return intervals;
  }
  static std::optional<Interval> interval_of(const std::vector<TrackPair>& pairs,
                                             const Eigen::Vector3d& place, double scale) {
    if (pairs.size() < kMinTrackPairs) return std::nullopt;
    const auto fit = TrackRegression(pairs, place, scale).fit(std::vector<int>(pairs.size(), 0));
    return fit ? std::make_optional<Interval>(*fit, pairs) : std::nullopt;
  }

  const std::vector<const Path*>& paths_;
  const VehicleTrack track_;
  const Eigen::Vector3d sensor_in_camera_;
  const ScaleParams& params_;
  std::vector<std::optional<double>> scale_;  // by path, each has a unit of its own
  std::vector<int> parts_;
  double positions_ = 0;
};

// The positions that lie within the paths by their own stamps and by corrected ones: a probability is
// compared with another of the same positions.
VehicleTrack within_both(const std::vector<const Path*>& paths, const VehicleTrack& track, double late_s) {
  const Timestamp first = paths.front()->front().time, last = paths.back()->back().time;
  const auto is_within = [&](Timestamp time) { return !(time < first) && !(last < time); };
  const VehicleTrack by_camera = corrected(track, late_s);
  VehicleTrack both = track;
  both.positions.clear();
  for (size_t i = 0; i < track.positions.size(); ++i)
    if (is_within(track.positions[i].time) && is_within(by_camera.positions[i].time))
      both.positions.push_back(track.positions[i]);
  return both;
}

// What the parts gain, without the fifth of them that gains most.
double trimmed_gain(const ClockFit::Cost& from, const ClockFit::Cost& to) {
  std::vector<double> gains;
  for (const auto& [part, cost] : from.of_part)
    if (const auto at = to.of_part.find(part); at != to.of_part.end()) gains.push_back(cost - at->second);
  std::sort(gains.begin(), gains.end());
  gains.resize(gains.size() - (gains.size() + kMinParts - 1) / kMinParts);
  return std::accumulate(gains.begin(), gains.end(), 0.0);
}

double best_of(ClockFit* fit, double from, double to, double step) {
  double best = from, least = kNever;
  for (double late = from; late < to + step / 2; late += step)
    if (const double cost = fit->cost(late).all; cost < least) least = cost, best = late;
  return best;
}

// The costs at offsets around the best one, by which it is refined.
struct Profile {
  std::vector<double> late;
  std::vector<ClockFit::Cost> costs;

  Profile(ClockFit* fit, double from, double to) {
    for (double x = from; x < to + kFineStep_s / 2; x += kFineStep_s)
      late.push_back(x), costs.push_back(fit->cost(x));
  }
  // The best offset, of all parts but one; all for a part that is none.
  double best(const Part& without) const {
    size_t best = 0;
    double least = kNever;
    for (size_t i = 0; i < late.size(); ++i) {
      const auto part = costs[i].of_part.find(without);
      const double cost = costs[i].all - (part != costs[i].of_part.end() ? part->second : 0);
      if (cost < least) least = cost, best = i;
    }
    return late[best];
  }
  // Standard deviation of the best offset by the jackknife over the parts (Efron 1982): what the path itself
  // is wrong by is no noise of the sensor.
  double sigma() const {
    std::vector<double> estimates;
    for (const auto& [part, cost] : costs[costs.size() / 2].of_part) estimates.push_back(best(part));
    const double n = double(estimates.size());
    if (n < 2) return kNever;
    const double mean = std::accumulate(estimates.begin(), estimates.end(), 0.0) / n;
    double squares = 0;
    for (const double estimate : estimates) squares += (estimate - mean) * (estimate - mean);
    return std::max(std::sqrt((n - 1) / n * squares), kFineStep_s / 2);
  }
};

}  // namespace

VehicleTrack corrected(VehicleTrack track, double late_s) {
  for (VehiclePosition& p : track.positions)
    p.time.ticks -= int64_t(std::llround(late_s * double(Timestamp::kTicksPerSecond)));
  return track;
}

std::optional<ClockOffset> clock_offset(const std::vector<const Path*>& paths, const VehicleTrack& track,
                                        const Eigen::Vector3d& sensor_in_camera, const ScaleParams& params) {
  if (paths.empty()) return std::nullopt;
  ClockFit search(paths, thinned(track), sensor_in_camera, params);
  const double coarse = best_of(&search, -kMaxOffset_s, kMaxOffset_s, kCoarseStep_s);
  const Profile profile(&search, coarse - kCoarseStep_s, coarse + kCoarseStep_s);
  const double late = profile.best({paths.size(), 0}), sigma = profile.sigma();
  // At the border it is beyond it.
  if (std::abs(late) > kMaxOffset_s - kFineStep_s) return std::nullopt;
  ClockFit fit(paths, within_both(paths, thinned(track), late), sensor_in_camera, params);
  const ClockFit::Cost as_stamped = fit.cost(0), corrected_by_it = fit.cost(late);
  const double chance = gain_by_chance(std::max(fit.positions(), 1.0), 1);
  if (!(trimmed_gain(as_stamped, corrected_by_it) > chance)) return std::nullopt;
  if (!(std::abs(late) > kCertainSigmas * sigma)) return std::nullopt;
  return ClockOffset{late, sigma};
}

}  // namespace edgevo
