// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Distance of matches from the exact correspondences.
#include <vector>

#include "edgevo/association/associate.h"
#include "edgevo/study/study_pair.h"

namespace edgevo {

/// End-point error above which a match is wrong, pixels.
constexpr double kWrongMatchPx = 2.0;

/// Error of one match.
struct MatchError {
  /// Kind of the match.
  MatchKind kind = MatchKind::kNone;
  /// Match minus truth along the normal and the tangent of the edge in the target, pixels.
  double normal_px = 0, tangent_px = 0;
  /// Confidence C_m of the match.
  double match_confidence = 0;
  /// Confidence C_d of the depth, 1/px.
  double depth_confidence = 0;
  /// Error of the inverse depth from the edge match, as motion of the projection, pixels.
  double depth_error_px = 0;
  /// End-point error, pixels.
  double norm() const { return std::hypot(normal_px, tangent_px); }
};

/// Errors of all matches whose point is visible in the target.
std::vector<MatchError> match_errors(const HostView& host, const TargetView& target,
                                     const std::vector<Match>& matches);

/// Statistics of the errors of many matches.
struct ErrorSummary {
  /// Number of matches.
  int count = 0;
  /// Median and mean end-point error, pixels.
  double median_px = 0, mean_px = 0;
  /// Medians of the absolute errors along normal and tangent, pixels.
  double median_normal_px = 0, median_tangent_px = 0;
  /// Share of matches with an end-point error above kWrongMatchPx.
  double wrong_share = 0;
};
/// Statistics of all `errors`; zeros for none.
ErrorSummary summarise(const std::vector<MatchError>& errors);

/// Inverse depth at which the point projects onto the tangent of its edge match, for the pose T_target_host:
/// g^T (p(rho) - m) = 0 is linear in rho. NaN where the tangent is parallel to the epipolar line.
double idepth_from_edge(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector2d& px_host,
                        const Match& match);

}  // namespace edgevo
