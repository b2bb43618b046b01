#pragma once
// How far matches lie from the exact correspondences.
#include <vector>

#include "edgevo/association/associate.h"
#include "edgevo/study/study_pair.h"

namespace edgevo {

constexpr double kWrongMatchPx = 2.0;  ///< a match further from the truth is wrong

/// One match.
struct MatchError {
  MatchKind kind = MatchKind::kNone;  ///< how it was found
  double normal_px = 0, tangent_px = 0;  ///< match minus truth along the axes of the edge in the target
  double match_confidence = 0;           ///< C_m
  double depth_confidence = 0;           ///< C_d, 1/px
  double depth_error_px = 0;             ///< of the inverse depth that the edge match gives, as motion of the projection
  double norm() const { return std::hypot(normal_px, tangent_px); }  ///< end-point error, pixels
};

/// Of all matches whose point is visible in the target.
std::vector<MatchError> match_errors(const HostView& host, const TargetView& target, const std::vector<Match>& matches);

/// Many matches.
struct ErrorSummary {
  int count = 0;  ///< matches
  double median_px = 0, mean_px = 0;                   ///< end-point error
  double median_normal_px = 0, median_tangent_px = 0;  ///< of the absolute values
  double wrong_share = 0;                              ///< end-point error above kWrongMatchPx
};
ErrorSummary summarise(const std::vector<MatchError>& errors);  ///< of all `errors`; zeros for none

/// Inverse depth at which the point projects onto the tangent of its edge match, for the pose T_target_host: g^T (p(rho) - m) = 0
/// is linear in rho. NaN where the tangent is parallel to the epipolar line.
double idepth_from_edge(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector2d& px_host, const Match& match);

}  // namespace edgevo
