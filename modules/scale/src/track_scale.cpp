// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/track_scale.h"

#include <Eigen/Geometry>
#include <cmath>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr double kMaxFrameGap_s = 0.5;    // between poses further apart the path is not a straight line
constexpr double kOutlierSigmas = 3.5;    // rejects one in two thousand correct positions
constexpr double kMedianPerSigma = 1.18;  // median of a 2-D normal distance: a vehicle moves in a plane
constexpr double kNoLength = 1e-12;       // metres: where all residuals are 0 none is an outlier
constexpr double kNoSpread = 1e-9;        // units or metres: positions that are all the same fit any scale
// Fits: all pairs, then without those far off the first, then the second.
constexpr int kRounds = 3;

SE3 interpolate(const SE3& a, const SE3& b, double share) {
  return {a.rotation().slerp(share, b.rotation()), (1 - share) * a.translation() + share * b.translation()};
}

struct Fit {
  double scale = 0, spread = 0;   // spread: root of the summed squares of the sources about their mean
  std::vector<double> residuals;  // distance of each pair, metres
};

// target ~ scale R source + t. The sensor's position in units of the run depends on the scale: it is computed
// with `scale_guess` > 0.
std::optional<Fit> fit_pairs(const std::vector<TrackPair>& pairs, const Eigen::Vector3d& sensor_in_camera,
                             double scale_guess) {
  Eigen::Matrix3Xd source(3, pairs.size()), target(3, pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    source.col(Eigen::Index(i)) = pairs[i].T_world_cam.translation();
    if (scale_guess > 0)
      source.col(Eigen::Index(i)) += pairs[i].T_world_cam.R() * sensor_in_camera / scale_guess;
    target.col(Eigen::Index(i)) = pairs[i].position;
  }
  const double spread = (source.colwise() - source.rowwise().mean()).norm();
  const double target_spread = (target.colwise() - target.rowwise().mean()).norm();
  if (!(spread > kNoSpread) || !(target_spread > kNoSpread)) return std::nullopt;
  const Eigen::Matrix4d T = Eigen::umeyama(source, target, true);
  Fit fit;
  fit.spread = spread;
  fit.scale = std::cbrt(T.topLeftCorner<3, 3>().determinant());
  if (!(fit.scale > 0) || !std::isfinite(fit.scale)) return std::nullopt;
  const Eigen::Matrix3Xd off =
      target - ((T.topLeftCorner<3, 3>() * source).colwise() + Eigen::Vector3d(T.topRightCorner<3, 1>()));
  for (Eigen::Index i = 0; i < off.cols(); ++i) fit.residuals.push_back(off.col(i).norm());
  return fit;
}

std::vector<TrackPair> without_outliers(const std::vector<TrackPair>& pairs,
                                        const std::vector<double>& residuals) {
  const double limit = kOutlierSigmas * median(residuals) / kMedianPerSigma + kNoLength;
  std::vector<TrackPair> kept;
  for (size_t i = 0; i < pairs.size(); ++i)
    if (residuals[i] <= limit) kept.push_back(pairs[i]);
  return kept;
}

}  // namespace

std::vector<TrackPair> pair_up(const Path& path, const VehicleTrack& track) {
  std::vector<TrackPair> pairs;
  size_t next = 1;  // first pose not before the position
  for (const VehiclePosition& p : track.positions) {
    while (next < path.size() && path[next].time < p.time) ++next;
    if (next >= path.size()) break;
    const PathPose &a = path[next - 1], &b = path[next];
    const double gap = seconds_between(a.time, b.time), since = seconds_between(a.time, p.time);
    if (since < 0 || !(gap > 0) || gap > kMaxFrameGap_s) continue;
    const double share = since / gap;
    pairs.push_back({(1 - share) * a.distance + share * b.distance,
                     interpolate(a.T_world_cam, b.T_world_cam, share), p.position});
  }
  return pairs;
}

std::optional<ScaleEstimate> fit_track(const std::vector<TrackPair>& all,
                                       const Eigen::Vector3d& sensor_in_camera, const ScaleParams& params) {
  std::vector<TrackPair> pairs = all;
  std::optional<Fit> fit;
  for (int round = 0; round < kRounds; ++round) {
    if (pairs.size() < kMinTrackPairs) return std::nullopt;
    fit = fit_pairs(pairs, sensor_in_camera, fit ? fit->scale : 0);
    if (!fit) return std::nullopt;
    if (round + 1 < kRounds) pairs = without_outliers(pairs, fit->residuals);
  }
  double squares = 0;
  for (const double r : fit->residuals) squares += r * r;
  const double n = double(pairs.size()), per_axis = std::sqrt(squares / n / 3);
  // Variance of a regression's slope, with the effective number of residuals.
  const double sigma = per_axis / fit->spread * std::sqrt(n / effective_count(fit->residuals)) / fit->scale;
  if (!(sigma <= params.max_sigma)) return std::nullopt;
  return ScaleEstimate{fit->scale, sigma, int(pairs.size())};
}

}  // namespace edgevo
