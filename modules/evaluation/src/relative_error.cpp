// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/relative_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/core/angle.h"
#include "edgevo/evaluation/absolute_error.h"

namespace edgevo {
namespace {

constexpr double kShortPath = 400;        // m
constexpr int kKittiFirstFrameStep = 10;  // frames, as in KITTI's devkit

// Input frames with ground truth and their positions along the true path.
struct Path {
  std::vector<int> frames;     // indices into the input
  std::vector<double> metres;  // distance from the first of them
  double length() const { return metres.empty() ? 0 : metres.back(); }
};

Path true_path(const std::vector<EvaluatedFrame>& frames) {
  Path path;
  for (size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].T_gt) continue;
    double s = 0;
    if (!path.frames.empty()) {
      const SE3& before = *frames[size_t(path.frames.back())].T_gt;
      s = path.metres.back() + (frames[i].T_gt->translation() - before.translation()).norm();
    }
    path.frames.push_back(int(i));
    path.metres.push_back(s);
  }
  return path;
}

std::vector<double> kitti_lengths() { return {100, 200, 300, 400, 500, 600, 700, 800}; }

std::vector<double> drift_lengths(double path_m) {
  if (path_m >= kShortPath) return kitti_lengths();
  return {0.05 * path_m, 0.10 * path_m, 0.20 * path_m, 0.30 * path_m};
}

// First entry of the path at least `length` beyond entry `begin`; -1 if it ends before.
int end_of_interval(const Path& path, int begin, double length) {
  const auto it =
      std::lower_bound(path.metres.begin() + begin, path.metres.end(), path.metres[size_t(begin)] + length);
  return it == path.metres.end() ? -1 : int(it - path.metres.begin());
}

SE3 relative_error(const MatchedPose& i, const MatchedPose& j, double scale) {
  SE3 motion_est = i.T_est.inverse() * j.T_est;
  motion_est = SE3(motion_est.rotation(), scale * motion_est.translation());
  return motion_est.inverse() * (i.T_gt.inverse() * j.T_gt);
}

// For each k, the number of frames before frame k with a pose.
std::vector<int> posed_before(const std::vector<EvaluatedFrame>& frames) {
  std::vector<int> count{0};
  for (const EvaluatedFrame& f : frames) count.push_back(count.back() + f.has_pose);
  return count;
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return 0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]);
}

// Drift of one interval, cm/m; nullopt where poses are missing.
std::optional<double> interval_drift(const std::vector<EvaluatedFrame>& frames, const std::vector<int>& posed,
                                     const std::vector<MatchedPose>& matches, int i, int j, double length_m) {
  const int total = j - i + 1;
  const int with_pose = posed[size_t(j) + 1] - posed[size_t(i)];
  const int match_i = frames[size_t(i)].match, match_j = frames[size_t(j)].match;
  if (match_i < 0 || match_j < 0 || 2 * with_pose <= total) return std::nullopt;
  const SE3 E = relative_error(matches[size_t(match_i)], matches[size_t(match_j)], 1.0);
  return 100.0 * E.translation().norm() / length_m;
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (double d : v) sum += d;
  return sum / double(v.size());
}

Drift::OfLength figures_of(const std::vector<double>& drifts) {
  if (drifts.empty()) return {};
  return {mean(drifts), median(drifts), *std::max_element(drifts.begin(), drifts.end()), int(drifts.size())};
}

}  // namespace

std::optional<Drift> drift(const std::vector<EvaluatedFrame>& frames,
                           const std::vector<MatchedPose>& metric_matches, double cap_cm_per_m) {
  const Path path = true_path(frames);
  if (!(path.length() > 0)) return std::nullopt;
  const std::vector<int> posed = posed_before(frames);
  Drift result;
  result.path_m = path.length();
  result.lengths_m = drift_lengths(path.length());
  std::vector<double> all;
  for (double length : result.lengths_m) {
    std::vector<double> drifts;
    for (int a = 0; a < int(path.frames.size()); ++a) {
      const int b = end_of_interval(path, a, length);
      if (b < 0) break;
      const double true_length = path.metres[size_t(b)] - path.metres[size_t(a)];
      const auto d = interval_drift(frames, posed, metric_matches, path.frames[size_t(a)],
                                    path.frames[size_t(b)], true_length);
      result.without_poses += !d;
      result.capped += d && *d > cap_cm_per_m;
      drifts.push_back(std::min(d.value_or(cap_cm_per_m), cap_cm_per_m));
    }
    result.by_length.push_back(figures_of(drifts));
    all.insert(all.end(), drifts.begin(), drifts.end());
  }
  if (all.empty()) return std::nullopt;
  result.intervals = int(all.size());
  result.mean_cm_per_m = mean(all);
  result.median_cm_per_m = median(all);
  return result;
}

std::optional<KittiRelative> kitti_relative(const std::vector<EvaluatedFrame>& frames,
                                            const std::vector<MatchedPose>& matches, double scale) {
  const Path path = true_path(frames);
  KittiRelative sum;
  for (int a = 0; a < int(path.frames.size()); a += kKittiFirstFrameStep)
    for (double length : kitti_lengths()) {
      const int b = end_of_interval(path, a, length);
      if (b < 0) break;
      const int i = frames[size_t(path.frames[size_t(a)])].match,
                j = frames[size_t(path.frames[size_t(b)])].match;
      if (i < 0 || j < 0) continue;
      const SE3 E = relative_error(matches[size_t(i)], matches[size_t(j)], scale);
      sum.t_rel_percent += 100.0 * E.translation().norm() / length;
      sum.r_rel_deg_per_100m += 100.0 * deg(E.angle()) / length;
      ++sum.intervals;
    }
  if (sum.intervals == 0) return std::nullopt;
  sum.t_rel_percent /= sum.intervals;
  sum.r_rel_deg_per_100m /= sum.intervals;
  return sum;
}

std::vector<ScalePoint> scale_curve(const std::vector<MatchedPose>& matches, int window_frames,
                                    double whole_scale) {
  const double spread_est = spread(estimate_points(matches)), spread_gt = spread(truth_points(matches));
  const auto at_frame = [&](int frame) {
    return std::lower_bound(matches.begin(), matches.end(), frame,
                            [](const MatchedPose& m, int f) { return m.frame < f; });
  };
  std::vector<ScalePoint> curve;
  const int stride = std::max(1, window_frames / 2);
  const int last = matches.empty() ? -1 : matches.back().frame;
  for (int start = 0; start == 0 || start + window_frames <= last + 1; start += stride) {
    const std::vector<MatchedPose> window(at_frame(start), at_frame(start + window_frames));
    if (window.size() < 3) continue;
    constexpr double kUnknown = -1;  // no scale is negative
    const double scale = interval_scale(window, spread_est, spread_gt, kUnknown);
    if (scale > 0) curve.push_back({window.front().frame, window.back().frame, whole_scale / scale});
  }
  return curve;
}

}  // namespace edgevo
