// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/absolute_error.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kStandstill = 1e-6;  // share of the spread of the whole run

AbsoluteError summarise(const Points& aligned, const Points& truth, double scale) {
  const Eigen::VectorXd distances = (aligned - truth).colwise().norm().transpose();
  std::vector<double> sorted(distances.data(), distances.data() + distances.size());
  std::sort(sorted.begin(), sorted.end());
  const size_t n = sorted.size();
  AbsoluteError e;
  e.rmse = std::sqrt(distances.squaredNorm() / double(n));
  e.mean = distances.mean();
  e.median = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
  e.max = sorted.back();
  e.poses = int(n);
  e.scale = scale;
  return e;
}

Points transformed(const Sim3& S, const Points& points) {
  return ((S.scale * S.rigid.R()) * points).colwise() + S.rigid.translation();
}

std::optional<AbsoluteError> after(const std::optional<Sim3>& fit, const Points& est, const Points& truth) {
  if (!fit) return std::nullopt;
  return summarise(transformed(*fit, est), truth, fit->scale);
}

double path_length(const Points& p) {
  double length = 0;
  for (Eigen::Index i = 1; i < p.cols(); ++i) length += (p.col(i) - p.col(i - 1)).norm();
  return length;
}

// Scale of each block that has poses.
std::vector<double> block_scales(const std::vector<MatchedPose>& matches, int block_frames, double fallback) {
  const double spread_est = spread(estimate_points(matches)), spread_gt = spread(truth_points(matches));
  std::vector<double> scales(size_t(matches.back().frame / block_frames) + 1, fallback);
  for (auto begin = matches.begin(); begin != matches.end();) {
    const int block = begin->frame / block_frames;
    const auto end = std::find_if(begin, matches.end(),
                                  [&](const MatchedPose& m) { return m.frame / block_frames != block; });
    scales[size_t(block)] = interval_scale({begin, end}, spread_est, spread_gt, fallback);
    begin = end;
  }
  return scales;
}

}  // namespace

Points estimate_points(const std::vector<MatchedPose>& matches) {
  Points points(3, Eigen::Index(matches.size()));
  for (size_t i = 0; i < matches.size(); ++i) points.col(Eigen::Index(i)) = matches[i].T_est.translation();
  return points;
}

Points truth_points(const std::vector<MatchedPose>& matches) {
  Points points(3, Eigen::Index(matches.size()));
  for (size_t i = 0; i < matches.size(); ++i) points.col(Eigen::Index(i)) = matches[i].T_gt.translation();
  return points;
}

std::optional<AbsoluteError> ate_sim3(const std::vector<MatchedPose>& matches) {
  const Points est = estimate_points(matches), truth = truth_points(matches);
  return after(fit_sim3(est, truth), est, truth);
}

std::optional<AbsoluteError> ate_se3(const std::vector<MatchedPose>& matches) {
  const Points est = estimate_points(matches), truth = truth_points(matches);
  return after(fit_se3(est, truth), est, truth);
}

double interval_scale(const std::vector<MatchedPose>& interval, double whole_spread_est,
                      double whole_spread_gt, double fallback) {
  const Points est = estimate_points(interval), truth = truth_points(interval);
  const bool moves =
      spread(est) > kStandstill * whole_spread_est && spread(truth) > kStandstill * whole_spread_gt;
  if (const auto fit = moves ? fit_sim3(est, truth) : std::nullopt) return fit->scale;
  const double path_est = path_length(est), path_gt = path_length(truth);
  const bool has_path = path_est > kStandstill * whole_spread_est && path_gt > kStandstill * whole_spread_gt;
  return has_path ? path_gt / path_est : fallback;
}

std::vector<MatchedPose> rescale_blocks(const std::vector<MatchedPose>& matches, int block_frames,
                                        double fallback) {
  if (matches.empty()) return {};
  const std::vector<double> scales = block_scales(matches, block_frames, fallback);
  std::vector<MatchedPose> out = matches;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < matches.size(); ++i) {
    if (i > 0) {
      const double scale = scales[size_t(matches[i - 1].frame / block_frames)];
      position += scale * (matches[i].T_est.translation() - matches[i - 1].T_est.translation());
    }
    out[i].T_est = SE3(matches[i].T_est.rotation(), position);
  }
  return out;
}

}  // namespace edgevo
