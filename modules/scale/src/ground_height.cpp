// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/ground_height.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "edgevo/core/point_filter.h"

namespace edgevo {
namespace {

constexpr int kMinGroundPoints = 20;       // least number of points in an interval
constexpr double kMaxAhead = 3;            // camera heights: beyond the end of a path the pitch would count
constexpr double kMaxPathPerDistance = 2;  // a point not passed after twice the distance to it never will be
// The direction of travel is taken over at least this many heights to each side.
constexpr double kDirectionHeights = 0.5;
constexpr int kDirectionFrames = 2;  // and over at least this many frames
constexpr double kMinChord = 0.5;    // of that reach: below this the camera is at rest or in pure rotation
// Sine of the angle between the direction of travel and the camera's downward direction: below this the
// camera looks up or down, or climbs.
constexpr double kMinLevel = 0.5;
constexpr double kLevel = 0.0175;   // radians: a degree
constexpr double kNearHeights = 4;  // a point further away is not passed yet

// Axes of the path at pose `j`: v forward, n down (perpendicular to v, in the plane of v and the camera's
// downward direction).
struct PathAxes {
  Eigen::Vector3d forward, down;
};

std::optional<PathAxes> path_axes(const Path& path, const Eigen::Vector3d& down_in_camera, size_t j,
                                  double reach) {
  const auto far_enough = [&](size_t i) {
    return std::abs(path[i].distance - path[j].distance) >= reach &&
           (i > j ? i - j : j - i) >= size_t(kDirectionFrames);
  };
  size_t a = j, b = j;
  while (a > 0 && !far_enough(a)) --a;
  while (b + 1 < path.size() && !far_enough(b)) ++b;
  const Eigen::Vector3d chord = path[b].T_world_cam.translation() - path[a].T_world_cam.translation();
  if (chord.norm() < kMinChord * reach) return std::nullopt;
  const Eigen::Vector3d forward = chord.normalized();
  const Eigen::Vector3d y = path[j].T_world_cam.R() * down_in_camera;
  const Eigen::Vector3d down = y - y.dot(forward) * forward;
  if (down.norm() < kMinLevel) return std::nullopt;  // not a drive over ground
  return PathAxes{forward, down.normalized()};
}

// A camera that looks back on its way has passed the points that it sees before it saw them: the last pose
// before `host` at which one was still ahead, or the first of the path.
std::optional<size_t> pose_passed_before(const Path& path, const Eigen::Vector3d& down, size_t host,
                                         const Eigen::Vector3d& p_world, double height_guess) {
  const double distance = (p_world - path[host].T_world_cam.translation()).norm();
  for (size_t j = host; j-- > 0;) {
    if (path[host].distance - path[j].distance > kMaxPathPerDistance * distance) return std::nullopt;
    const auto axes = path_axes(path, down, j, kDirectionHeights * height_guess);
    if (axes && (p_world - path[j].T_world_cam.translation()).dot(axes->forward) >= 0) return j;
  }
  return 0;
}

bool lies_behind(const Path& path, const Eigen::Vector3d& down, size_t host, const Eigen::Vector3d& p_world,
                 double height_guess) {
  const auto axes = path_axes(path, down, host, kDirectionHeights * height_guess);
  return axes && (p_world - path[host].T_world_cam.translation()).dot(axes->forward) < 0;
}

// The pose of the path at which the camera is level with the point; the last one if there is none and the
// path has ended.
std::optional<size_t> passing_pose(const Path& path, const Eigen::Vector3d& down, size_t host,
                                   const Eigen::Vector3d& p_world, double height_guess, bool is_path_ended) {
  if (lies_behind(path, down, host, p_world, height_guess))
    return pose_passed_before(path, down, host, p_world, height_guess);
  const double distance = (p_world - path[host].T_world_cam.translation()).norm();
  for (size_t j = host; j < path.size(); ++j) {
    if (path[j].distance - path[host].distance > kMaxPathPerDistance * distance) return std::nullopt;
    const Eigen::Vector3d d = p_world - path[j].T_world_cam.translation();
    if (d.squaredNorm() > kNearHeights * kNearHeights * height_guess * height_guess) continue;
    const auto axes = path_axes(path, down, j, kDirectionHeights * height_guess);
    if (axes && d.dot(axes->forward) <= 0) return j;
  }
  if (is_path_ended && !path.empty()) return path.size() - 1;
  return std::nullopt;
}

std::optional<HeightSample> look_at(const Path& path, const Eigen::Vector3d& down, size_t host,
                                    const Eigen::Vector3d& p_cam, bool is_path_ended,
                                    const ScaleParams& params) {
  const double guess = p_cam.dot(down);  // the height, if the camera looked straight ahead
  if (!(guess > 0)) return std::nullopt;
  const Eigen::Vector3d p_world = path[host].T_world_cam * p_cam;
  const auto j = passing_pose(path, down, host, p_world, guess, is_path_ended);
  if (!j) return std::nullopt;
  const auto axes = path_axes(path, down, *j, kDirectionHeights * guess);
  if (!axes) return std::nullopt;
  const Eigen::Vector3d d = p_world - path[*j].T_world_cam.translation();
  const double height = d.dot(axes->down), aside = std::abs(d.dot(axes->down.cross(axes->forward)));
  if (!(height > 0) || aside > params.ground_width * height ||
      std::abs(d.dot(axes->forward)) > kMaxAhead * height)
    return std::nullopt;
  return HeightSample{path[*j].distance, height};
}

// ---- the mode of the heights: a histogram of their logarithms, smoothed, then the weighted mean around its
// peak ----

// Bins of log height: 1 %, smoothed to about the spread of the ground, which gives one peak.
constexpr double kBin = 0.01, kSmoothing = 0.03;
// Spread of log height: three of it hold 97 % of the ground points of a drive.
constexpr double kWidth = 0.04;
constexpr double kReachSigmas = 3;  // beyond it a normal weight is negligible
constexpr int kMeanShifts = 20;     // more than the mean needs to converge
constexpr double kMinShare = 0.5;   // of the samples near the mode: drives give 0.97, heights spread evenly
                                    // up to the largest 0.3 to 0.4

double histogram_peak(const std::vector<double>& logs) {
  const auto [low, high] = std::minmax_element(logs.begin(), logs.end());
  const int reach = int(std::ceil(kReachSigmas * kSmoothing / kBin));
  std::vector<double> bins(size_t((*high - *low) / kBin) + 1 + 2 * size_t(reach), 0.0);
  for (const double x : logs) {
    const double at = (x - *low) / kBin + reach;
    for (int i = int(at) - reach; i <= int(at) + reach && i < int(bins.size()); ++i) {
      const double off = (i + 0.5 - at) * kBin / kSmoothing;
      if (i >= 0) bins[size_t(i)] += std::exp(-0.5 * off * off);
    }
  }
  const auto peak = std::max_element(bins.begin(), bins.end()) - bins.begin();
  return *low + (double(peak) + 0.5 - reach) * kBin;
}

double weight(double x, double mode) { return std::exp(-0.5 * (x - mode) * (x - mode) / (kWidth * kWidth)); }

double mean_shift(const std::vector<double>& logs, double mode) {
  for (int i = 0; i < kMeanShifts; ++i) {
    double sum = 0, weights = 0;
    for (const double x : logs) sum += weight(x, mode) * x, weights += weight(x, mode);
    mode = sum / weights;
  }
  return mode;
}

// A sample near the mode: log height minus the mode.
struct Residual {
  double distance = 0, value = 0;
};

// Standard deviation of the mean of the residuals, by batch means. Heights over the points of one keyframe
// share the errors of its pose, and those of one place the shape of the road there: so the path is cut into
// intervals, and their means show by how much the mean of all is uncertain, whatever the errors have in
// common within an interval. What is left between neighbours is in effective_count(). Infinite for fewer than
// four intervals.
double sigma_by_intervals(const std::vector<Residual>& residuals) {
  constexpr int kIntervals = 10;
  constexpr size_t kMin = 4;
  const auto [first, last] =
      std::minmax_element(residuals.begin(), residuals.end(),
                          [](const auto& a, const auto& b) { return a.distance < b.distance; });
  const double begin = first->distance, length = last->distance - begin;
  std::array<double, kIntervals> sums{}, counts{};
  for (const Residual& r : residuals) {
    const double at = length > 0 ? (r.distance - begin) / length : 0;
    const auto interval = size_t(std::clamp(int(kIntervals * at), 0, kIntervals - 1));
    sums[interval] += r.value, ++counts[interval];
  }
  std::vector<double> means;
  for (size_t i = 0; i < kIntervals; ++i)
    if (counts[i] > 0) means.push_back(sums[i] / counts[i]);
  if (means.size() < kMin) return std::numeric_limits<double>::infinity();
  const double n = double(means.size());
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / n;
  double squares = 0;
  for (double& m : means) m -= mean, squares += m * m;
  // So many standard deviations of a normal distribution are two of Student's with n - 1 degrees of freedom.
  const double student = std::sqrt((n - 1) / (n - 3));
  return student * std::sqrt(squares / (n - 1) / effective_count(means));
}

}  // namespace

Eigen::Vector3d down_in_camera(const std::optional<SE3>& T_vehicle_cam) {
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  if (!T_vehicle_cam) return y;
  const Eigen::Vector3d down = T_vehicle_cam->rotation().conjugate() * -Eigen::Vector3d::UnitZ();
  return down.dot(y) > std::cos(kLevel) ? y : down;
}

std::vector<HeightSample> ground_heights(const Pinhole& pinhole, const KeyframeRecord& keyframe,
                                         const Eigen::Vector3d& down, const Path& path, bool is_path_ended,
                                         const ScaleParams& params) {
  const auto host = std::lower_bound(path.begin(), path.end(), keyframe.frame_index,
                                     [](const PathPose& p, int index) { return p.frame_index < index; });
  std::vector<HeightSample> samples;
  if (host == path.end() || host->frame_index != keyframe.frame_index) return samples;
  const PointFilter filter;
  for (const EdgePoint& point : keyframe.points) {
    if (!filter.keeps(point)) continue;
    const auto sample = look_at(path, down, size_t(host - path.begin()), point_in_camera(pinhole, point),
                                is_path_ended, params);
    if (sample) samples.push_back(*sample);
  }
  return samples;
}

std::vector<HeightSample> ground_heights(const Run& run, const Path& path, const ScaleParams& params) {
  const Eigen::Vector3d down = down_in_camera(run.T_vehicle_cam);
  std::vector<HeightSample> heights;
  for (const KeyframeRecord& k : run.keyframes) {
    const std::vector<HeightSample> more = ground_heights(run.pinhole, k, down, path, true, params);
    heights.insert(heights.end(), more.begin(), more.end());
  }
  return heights;
}

std::optional<ScaleEstimate> fit_height(const std::vector<HeightSample>& samples, double camera_height,
                                        const ScaleParams& params) {
  if (int(samples.size()) < kMinGroundPoints) return std::nullopt;
  std::vector<double> logs;
  for (const HeightSample& s : samples) logs.push_back(std::log(s.height));
  const double mode = mean_shift(logs, histogram_peak(logs));
  std::vector<Residual> residuals;
  for (size_t i = 0; i < logs.size(); ++i)
    if (std::abs(logs[i] - mode) < kReachSigmas * kWidth)
      residuals.push_back({samples[i].distance, logs[i] - mode});
  if (double(residuals.size()) < kMinShare * double(logs.size()) || int(residuals.size()) < kMinGroundPoints)
    return std::nullopt;
  const double sigma = std::hypot(sigma_by_intervals(residuals), params.ground_sigma);
  if (!(sigma <= params.max_sigma)) return std::nullopt;
  return ScaleEstimate{camera_height / std::exp(mode), sigma, int(residuals.size())};
}

std::optional<double> seen_camera_height(const Run& run, const ScaleParams& params) {
  std::map<int, Path> paths;  // of the keyframes, by segment
  for (const KeyframeRecord& k : run.keyframes)
    extend(k.frame_index, k.time, k.T_world_cam, &paths[k.segment]);
  const Eigen::Vector3d down = down_in_camera(run.T_vehicle_cam);
  std::vector<HeightSample> heights;
  for (const KeyframeRecord& k : run.keyframes) {
    const std::vector<HeightSample> more =
        ground_heights(run.pinhole, k, down, paths[k.segment], true, params);
    heights.insert(heights.end(), more.begin(), more.end());
  }
  const auto fit = fit_height(heights, 1.0, params);
  return fit ? std::make_optional(1.0 / fit->factor) : std::nullopt;
}

}  // namespace edgevo
