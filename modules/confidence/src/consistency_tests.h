// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One function for each consistency test (confidence/motion_confidence.h): from a measurement to an
// inconsistency, 0 to 3, that grows with the suspicion. A measurement that is unknown (NaN) is no suspicion
// by itself; that nothing could be checked is a test of its own, inconsistency_without_cross_check(). Numbers
// below are the defaults of ConsistencyParams.
#include <optional>

#include "edgevo/confidence/status_params.h"
#include "edgevo/core/frame_evidence.h"

namespace edgevo {

/// Largest inconsistency: one test alone does not decide by any amount.
inline constexpr double kMaxInconsistency = 3;

/// Difference between the motion over ten frames and that of the corners, beyond 2.5 standard deviations of
/// its length and one of its rotation: 1 where the motion counts as wrong (a quarter of its length and 2 % of
/// the depth, or 3 degrees). Without a scale (standard deviation of change_10 above 0.3: a rotation on the
/// spot) only the rotation counts.
double inconsistency_of_corner_motion(const CornerEvidence& c, const ConsistencyParams& params = {});
/// Error of the turn over ten frames, `turn_deg`, that a wrong focal length makes: 1 for 3 degrees, since a
/// turn is the way of the image over the focal length. `focal_error`: true focal length over the camera's,
/// less 1; 0 within two of its standard deviations, which estimates of right cameras reach.
double inconsistency_of_focal_length(double focal_error, double sigma, double turn_deg,
                                     const ConsistencyParams& params = {});
/// Change of the map's unit over the last ten, or the last fifty frames, beyond one standard deviation: 1 for
/// a factor of 1.25 either way.
double inconsistency_of_corner_scale(const CornerEvidence& c);
/// Share of the corners that break the epipolar constraint: 1 for a half.
double inconsistency_of_corner_agreement(const CornerEvidence& c);
/// 1 without corners, or if the standard deviation of their motion is a quarter of it or more; less for a
/// smaller one, 0 from a tenth on. A motion that is too short to be wrong needs no check of its length. 3
/// if the largest standard deviation of the pose is a tenth (of the depth, of a radian) as well, or unknown.
double inconsistency_without_cross_check(const std::optional<CornerEvidence>& c, double pose_sigma,
                                         const ConsistencyParams& params = {});
/// A translation that the turn over ten frames hides: rows read out one after another, a residual distortion
/// and wrong depths all make a turn look like a translation in proportion to it, for edges and for corners
/// alike. `error_per_rad`: what the two differ by, in median depths per radian of turn, in this run
/// (turn_error()). 1 where that much makes the motion wrong: 2 % of the depth and a quarter of the length.
/// `length_depths`: length of the motion, median depths.
double inconsistency_of_turn(double turn_rad, double length_depths, double error_per_rad);
/// Difference between the motion over ten frames and that of the corners, median depths per radian of turn;
/// NaN: unknown, or hardly a turn.
double turn_error(const CornerEvidence& c, double turn_rad, const ConsistencyParams& params = {});
/// Natural logarithm of the recent mean step over the usual one, either way. Steps up to `small_step`
/// median depths do not count. At most 1: a camera that speeds up makes such steps, too.
double inconsistency_of_step(double recent, double usual, double median_depth,
                             double small_step = StepGateParams().small,
                             const ConsistencyParams& params = {});
/// Natural logarithm of the RMS distance between edges and the points that they match, pixels, over the 0.6
/// of right runs.
double inconsistency_of_residual(double residual_px, const ConsistencyParams& params = {});
/// Natural logarithm of the squared move of keyframes over the expected one, at most 1.
double inconsistency_of_adjustment(double moved, const ConsistencyParams& params = {});
/// Lack of support, summed up: inlier share (0 at 0.7, 1 at 0.4), points of known depth (0 at 300, 1 at 40),
/// and share of the map in view (0 at 0.3, 1 at 0).
double inconsistency_of_starvation(const FrameEvidence& evidence, const ConsistencyParams& params = {});
/// Blur above what is usual in the run and above that of sharp edges, and saturated pixels beyond the usual
/// share (1: 30 % more).
double inconsistency_of_image(double blur, double usual_blur, double saturated_share, double usual_saturated,
                              const ConsistencyParams& params = {});

}  // namespace edgevo
