// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/corner_motion.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/features/corner_tracking.h"
#include "edgevo/features/two_view_motion.h"

namespace edgevo {
namespace {

// RANSAC runs, of which the one with more inliers is used. The second one helps if the first misses a good
// sample; each takes a third of the time.
constexpr int kTrials = 2;
constexpr int kMaxFollowedCorners = 450;   // followed from the last keyframe
constexpr double kCornerRansacPx = 1.0;    // inlier threshold of the essential matrix
constexpr double kMinAgreeingShare = 0.7;  // of the corners that could be followed
// Median over the inliers after derotation; with less parallax the direction is not observable.
constexpr double kMinParallaxDeg = 0.3;

// Corners of the first image, and their predicted pixels in the second after a rotation; those that leave the
// view are skipped.
struct PredictedCorners {
  Corners from, to;
};
PredictedCorners predict_corners(const Pinhole& pinhole, const Corners& corners, const Eigen::Matrix3d& R) {
  PredictedCorners f;
  for (const cv::Point2f& corner : corners) {
    const Eigen::Vector3d ray = R * pinhole.ray({corner.x, corner.y});
    if (!(ray.z() > 0) || !pinhole.contains(pinhole.project(ray))) continue;
    const Eigen::Vector2d px = pinhole.project(ray);
    f.from.push_back(corner);
    f.to.emplace_back(float(px.x()), float(px.y()));
  }
  return f;
}

}  // namespace

std::optional<CornerMotion> find_corner_motion(const Pinhole& pinhole, const FramePyramid& from,
                                               const FramePyramid& to, const SE3& T_to_from,
                                               const CornerParams& params, Random* random) {
  const cv::Mat image_from = equalised(from);
  Corners start = find_corners(image_from, kMaxFollowedCorners);
  drop_own(from, &start);
  drop_on_edges(image_from, params.max_sigma_px, &start);
  PredictedCorners corners = predict_corners(pinhole, start, T_to_from.R());
  const std::vector<bool> found = follow_corners(image_from, equalised(to), corners.from, &corners.to);
  Corners first, last;
  for (size_t i = 0; i < found.size(); ++i)
    if (found[i]) first.push_back(corners.from[i]), last.push_back(corners.to[i]);
  if (int(first.size()) < params.min_agreeing) return std::nullopt;
  const std::vector<TwoViewMotion> motions =
      estimate_motions(pinhole, first, last, kCornerRansacPx, kTrials, random);
  if (motions.empty()) return std::nullopt;
  const auto agreeing = [](const TwoViewMotion& m) { return cv::countNonZero(m.inliers); };
  const TwoViewMotion& best =
      *std::max_element(motions.begin(), motions.end(),
                        [&](const auto& a, const auto& b) { return agreeing(a) < agreeing(b); });
  const bool few =
      agreeing(best) < std::max(double(params.min_agreeing), kMinAgreeingShare * double(first.size()));
  if (few || best.parallax_rad < rad(kMinParallaxDeg)) return std::nullopt;
  CornerMotion motion;
  motion.T_to_from = best.T_last_first;
  for (size_t i = 0; i < first.size(); ++i)
    if (best.inliers.at<uchar>(int(i)))
      motion.pairs.push_back({pinhole.ray({first[i].x, first[i].y}), pinhole.ray({last[i].x, last[i].y})});
  return motion;
}

}  // namespace edgevo
