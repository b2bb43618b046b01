// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motion between two views from matched corners: essential matrices by RANSAC, each refined over all inlier
// corners.
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/random.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// A motion between two views, and how well the corners fit it.
struct TwoViewMotion {
  /// Motion between the views, |translation| = 1.
  SE3 T_last_first;
  /// CV_8U, one per corner: non-zero if it fits within the threshold, in front of both views.
  cv::Mat inliers;
  /// Median distance from the epipolar line over all corners, pixels.
  double median_error_px = 0;
  /// Median angle between the two rays after derotation, radians.
  double parallax_rad = 0;
  /// What it was found by, in words.
  const char* model = "essential matrix";
};

/// Rotation between two views that is known: of a gyro, or since both were located in a map.
struct TurnOfViews {
  /// From the first view to the last.
  Eigen::Quaterniond R_last_first = Eigen::Quaterniond::Identity();
  /// Inverse of the covariance of w in R <- exp(w) R, rad^-2.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();

  /// Whether a rotation is three standard deviations off.
  bool contradicts(const Eigen::Quaterniond& R) const;
};

/// The motions of `trials` RANSAC runs, each on corners in another random order. May be empty.
std::vector<TwoViewMotion> estimate_motions(const Pinhole& pinhole, const std::vector<cv::Point2f>& first,
                                            const std::vector<cv::Point2f>& last, double ransac_px,
                                            int trials, Random* random);

/// The motions that a plane through most corners allows: two between two views, of which one is wrong; one
/// is known from the other by further views only (view_fit.h). May be empty.
std::vector<TwoViewMotion> estimate_motions_of_plane(const Pinhole& pinhole,
                                                     const std::vector<cv::Point2f>& first,
                                                     const std::vector<cv::Point2f>& last, double ransac_px);

/// The motion with that rotation: two corners show the direction of the translation. Nothing if no two do.
std::optional<TwoViewMotion> estimate_motion_with_turn(const Pinhole& pinhole,
                                                       const std::vector<cv::Point2f>& first,
                                                       const std::vector<cv::Point2f>& last, double ransac_px,
                                                       const TurnOfViews& turn, Random* random);

/// A motion as it is, with its inliers, error and parallax.
TwoViewMotion measure_motion(const Pinhole& pinhole, const std::vector<cv::Point2f>& first,
                             const std::vector<cv::Point2f>& last, double ransac_px, const SE3& T_last_first);

/// The motion refined from `start` over the corners that agree with it, and with `turn`, if there is one.
TwoViewMotion refined_motion(const Pinhole& pinhole, const std::vector<cv::Point2f>& first,
                             const std::vector<cv::Point2f>& last, double ransac_px, const SE3& start,
                             const TurnOfViews* turn = nullptr);

/// The motions without those that repeat an earlier one.
std::vector<TwoViewMotion> without_repeats(std::vector<TwoViewMotion> motions);

/// True if the rotations differ by more than a share of the parallax that depths would come from.
bool disagree(const SE3& a, const SE3& b, double parallax_rad);

/// True if motions that fit about as well as `best` disagree on the rotation by more than a share of the
/// parallax that depths would come from: with little parallax a wrong rotation with a wrong translation fits
/// nearly as well as the right ones (lab 2026-11-22_bootstrap).
bool is_ambiguous(const TwoViewMotion& best, const std::vector<TwoViewMotion>& motions);

/// Refines a motion by Gauss-Newton on the distances from the epipolar lines, over rotation and translation
/// direction (five unknowns), with Huber weights at `huber_px`. `rays_first` and `rays_last` are (x, y, 1).
/// `turn`, if there is one, counts against corners whose standard deviation is `huber_px`.
SE3 refine_motion(const SE3& T_last_first, const std::vector<Eigen::Vector3d>& rays_first,
                  const std::vector<Eigen::Vector3d>& rays_last, double focal_px, double huber_px,
                  const TurnOfViews* turn = nullptr);

/// Angle between two rays, radians; exact for small ones.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace edgevo
