// SPDX-License-Identifier: BSD-3-Clause
#include "source_samples.h"

#include <algorithm>
#include <cmath>

#include "edgevo/scale/live_scale.h"

namespace edgevo {
namespace {

// Of the variance of height and ground: the height is the same all along, the ground is not.
constexpr double kCommonShare = 0.5;

// The samples within an interval, from a list sorted by travelled distance.
template <class Sample>
std::pair<size_t, size_t> in_interval(const std::vector<Sample>& sorted, double begin, double end) {
  const auto first = std::lower_bound(sorted.begin(), sorted.end(), begin,
                                      [](const Sample& s, double w) { return s.distance < w; });
  const auto last =
      std::upper_bound(first, sorted.end(), end, [](double w, const Sample& s) { return w < s.distance; });
  return {size_t(first - sorted.begin()), size_t(last - sorted.begin())};
}

template <class Sample>
std::vector<Sample> part(const std::vector<Sample>& all, const std::pair<size_t, size_t>& range) {
  return {all.begin() + std::ptrdiff_t(range.first), all.begin() + std::ptrdiff_t(range.second)};
}

std::optional<IntervalFit> fit_positions(const SourceSamples& samples, double begin, double end,
                                         const ScaleParams& params) {
  const auto range = in_interval(samples.pairs, begin, end);
  const PositionKind kind = samples.source.kind == ScaleSource::Kind::kOdometry ? PositionKind::kIntegrated
                                                                                : PositionKind::kAbsolute;
  const auto fit = fit_track(part(samples.pairs, range), kind, samples.sensor_in_camera, params);
  if (!fit) return std::nullopt;
  IntervalFit found{fit->scale, fit->R_sensor_world, {}, {}};
  for (const TrackJump& jump : fit->jumps) found.jumps.push_back({range.first + jump.at, jump.by});
  for (const size_t pair : fit->scattered) found.scattered.push_back(range.first + pair);
  return found;
}

ScaleParams own_params(const ScaleParams& params) {
  ScaleParams own = params;
  own.ground_sigma = std::sqrt(1 - kCommonShare) * params.ground_sigma;
  return own;
}

}  // namespace

SourceSamples positions_along(const Path& path, const ScaleSource& source, const VehicleTracks& tracks,
                              const std::optional<SE3>& T_vehicle_cam) {
  SourceSamples samples;
  samples.source = source;
  const auto track = source.sensor() ? tracks.find(*source.sensor()) : tracks.end();
  if (track == tracks.end()) return samples;
  samples.pairs = pair_up(path, track->second);
  samples.sensor_in_camera = sensor_in_camera(track->second, T_vehicle_cam);
  return samples;
}

std::optional<IntervalFit> fit_interval(const SourceSamples& samples, double begin, double end,
                                        const ScaleParams& params) {
  if (samples.source.sensor()) return fit_positions(samples, begin, end, params);
  const auto fit = fit_height(part(samples.heights, in_interval(samples.heights, begin, end)),
                              samples.source.value, own_params(params));
  if (!fit) return std::nullopt;
  return IntervalFit{*fit, Eigen::Matrix3d::Identity(), {}, {}};
}

std::optional<double> rough_scale(const SourceSamples& samples, const ScaleParams& params) {
  if (samples.source.sensor()) return rough_scale(samples.pairs);
  const auto fit = fit_height(samples.heights, samples.source.value, params);
  return fit ? std::make_optional(fit->factor) : std::nullopt;
}

double common_sigma(const ScaleSource& source, const ScaleParams& params) {
  return source.kind == ScaleSource::Kind::kCameraHeight ? std::sqrt(kCommonShare) * params.ground_sigma : 0;
}

}  // namespace edgevo
