// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/study/match_error.h"

#include <cmath>
#include <limits>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

// Error of the projection for this inverse depth, in pixels at the tracked pose.
double depth_error_px(const Pinhole& camera, const SE3& T, const StudyPoint& point, double idepth) {
  const Eigen::Vector3d ray = camera.ray(point.px);
  const Projection right = project(camera, T.R(), T.translation(), ray, point.idepth_true);
  const Projection found = project(camera, T.R(), T.translation(), ray, idepth);
  return right.valid && found.valid ? (found.px - right.px).norm() : std::numeric_limits<double>::infinity();
}

}  // namespace

double idepth_from_edge(const Pinhole& camera, const SE3& T, const Eigen::Vector2d& px_host,
                        const Match& match) {
  // g^T (f Y.xy + (c - m) Y.z) = 0 with Y = R x + rho t.
  const auto row = [&](const Eigen::Vector3d& Y) {
    return match.normal.x() * (camera.fx * Y.x() + (camera.cx - match.px.x()) * Y.z()) +
           match.normal.y() * (camera.fy * Y.y() + (camera.cy - match.px.y()) * Y.z());
  };
  const double slope = row(T.translation());
  return slope != 0 ? -row(T.R() * camera.ray(px_host)) / slope : std::numeric_limits<double>::quiet_NaN();
}

std::vector<MatchError> match_errors(const HostView& host, const TargetView& target,
                                     const std::vector<Match>& matches) {
  const Pinhole& camera = target.pyramid->finest().pinhole;
  const SE3& T = target.track.T_cur_ref;
  std::vector<MatchError> errors;
  for (size_t i = 0; i < matches.size(); ++i) {
    const Match& m = matches[i];
    if (m.kind == MatchKind::kNone || !target.truth[i].visible) continue;
    const Eigen::Vector2d d = m.px - target.truth[i].px, along(-m.normal.y(), m.normal.x());
    MatchError e;
    e.kind = m.kind;
    e.normal_px = m.normal.dot(d);
    e.tangent_px = along.dot(d);
    e.match_confidence = m.match_confidence;
    e.depth_confidence = m.depth_confidence;
    e.depth_error_px =
        depth_error_px(camera, T, host.points[i], idepth_from_edge(camera, T, host.points[i].px, m));
    errors.push_back(e);
  }
  return errors;
}

ErrorSummary summarise(const std::vector<MatchError>& errors) {
  ErrorSummary s;
  s.count = int(errors.size());
  if (errors.empty()) return s;
  std::vector<double> norm, normal, tangent;
  for (const MatchError& e : errors) {
    norm.push_back(e.norm());
    normal.push_back(std::abs(e.normal_px));
    tangent.push_back(std::abs(e.tangent_px));
    s.mean_px += norm.back() / s.count;
    s.wrong_share += double(norm.back() > kWrongMatchPx) / s.count;
  }
  s.median_px = median(norm);
  s.median_normal_px = median(normal);
  s.median_tangent_px = median(tangent);
  return s;
}

}  // namespace edgevo
