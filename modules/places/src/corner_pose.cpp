// SPDX-License-Identifier: BSD-3-Clause
#include "corner_pose.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

#include "edgevo/opencv_bridge/opencv_pose.h"
#include "false_alarms.h"

namespace edgevo {
namespace {

// A corner has the depth of the nearest map point within so many pixels.
constexpr float kNearPx = 5;
// Corners of depths that are known to a third.
constexpr double kMaxRelativeSigma = 0.3;
// Best distance over second best, and the best one, of 256 bits, of corners that look alike: half of all bits
// differ by chance.
constexpr float kDistinct = 0.9F, kMaxPairBits = 80;
// Corners agree with a pose within so many pixels: the place of a descriptor, and what its depth is off by.
constexpr float kAgreePx = 4;
constexpr int kTries = 1000;
// Cells that points are looked up in, pixels: some ten thousand in an image.
constexpr float kMinCell = 8;
// Of so few pairs none proves a pose.
constexpr int kMinPairs = 6;
constexpr double kConfidence = 0.999;

// A row for each; shares the bytes.
cv::Mat rows_of(const ViewCorners& corners) {
  if (corners.descriptors.empty()) return {};
  return {int(corners.descriptors.size()), int(sizeof(CornerDescriptor)), CV_8U,
          const_cast<uint8_t*>(corners.descriptors.front().data())};
}

// The pairs that are nearest to each other and unmistakable, as rows of the descriptors.
std::vector<cv::DMatch> pairs_alike(const ViewCorners& of_a, const ViewCorners& of_b) {
  const cv::Mat a = rows_of(of_a), b = rows_of(of_b);
  std::vector<cv::DMatch> pairs;
  if (a.rows < 2 || b.rows < 2) return pairs;
  const cv::BFMatcher matcher(cv::NORM_HAMMING);
  std::vector<std::vector<cv::DMatch>> there, back;
  matcher.knnMatch(a, b, there, 2);
  matcher.knnMatch(b, a, back, 1);
  for (const std::vector<cv::DMatch>& m : there) {
    if (m.size() < 2 || m[0].distance > kMaxPairBits || m[0].distance > kDistinct * m[1].distance) continue;
    if (back[size_t(m[0].trainIdx)][0].trainIdx == m[0].queryIdx) pairs.push_back(m[0]);
  }
  return pairs;
}

struct SpacePixels {
  std::vector<cv::Point3d> in_a;  // points in the frame of view a
  std::vector<cv::Point2d> in_b;  // where view b shows them
};

SpacePixels with_depths(const Pinhole& pinhole, const PlaceView& a, const PlaceView& b) {
  const NearestPoint nearest(pinhole, a.points, kNearPx);
  SpacePixels found;
  for (const cv::DMatch& m : pairs_alike(a.view.corners, b.view.corners)) {
    const Eigen::Vector2f& px = a.view.corners.px[size_t(m.queryIdx)];
    const CloudPoint* point = nearest.find(px);
    if (!point || !(point->idepth > 0) || point->idepth_sigma > kMaxRelativeSigma * point->idepth) continue;
    const Eigen::Vector3d X = pinhole.ray(px.cast<double>()) / point->idepth;
    const Eigen::Vector2f& seen = b.view.corners.px[size_t(m.trainIdx)];
    found.in_a.emplace_back(X.x(), X.y(), X.z()), found.in_b.emplace_back(seen.x(), seen.y());
  }
  return found;
}

// That most agree with, of those by three corners; then the one that fits these best.
std::optional<SE3> pose_of(const Pinhole& pinhole, const SpacePixels& pairs) {
  const cv::Mat K = camera_matrix(pinhole);
  cv::Mat turn, t, R, agreeing;
  if (!cv::solvePnPRansac(pairs.in_a, pairs.in_b, K, cv::noArray(), turn, t, false, kTries, kAgreePx,
                          kConfidence, agreeing, cv::SOLVEPNP_P3P))
    return std::nullopt;
  std::vector<cv::Point3d> in_a;
  std::vector<cv::Point2d> in_b;
  for (int i = 0; i < agreeing.rows; ++i) {
    in_a.push_back(pairs.in_a[size_t(agreeing.at<int>(i))]);
    in_b.push_back(pairs.in_b[size_t(agreeing.at<int>(i))]);
  }
  cv::solvePnPRefineLM(in_a, in_b, K, cv::noArray(), turn, t);
  cv::Rodrigues(turn, R);
  const SE3 T_b_a = to_se3(R, to_vector(t));
  return T_b_a.is_finite() ? std::optional(T_b_a) : std::nullopt;
}

int count_agreeing(const Pinhole& pinhole, const SpacePixels& pairs, const SE3& T_b_a) {
  int agreeing = 0;
  for (size_t i = 0; i < pairs.in_a.size(); ++i) {
    const Eigen::Vector3d X = T_b_a * Eigen::Vector3d(pairs.in_a[i].x, pairs.in_a[i].y, pairs.in_a[i].z);
    const Eigen::Vector2d seen(pairs.in_b[i].x, pairs.in_b[i].y);
    agreeing += X.z() > 0 && (pinhole.project(X) - seen).norm() < kAgreePx;
  }
  return agreeing;
}

// That a corner anywhere in the view agrees with a pose.
double chance_of_agreeing(const Pinhole& pinhole) {
  return M_PI * kAgreePx * kAgreePx / (double(pinhole.width) * pinhole.height);
}

}  // namespace

NearestPoint::NearestPoint(const Pinhole& pinhole, const std::vector<CloudPoint>& points, float radius)
    : points_(&points),
      radius_(radius),
      cell_(std::max(radius, kMinCell)),
      columns_(int(float(pinhole.width) / cell_) + 1),
      rows_(int(float(pinhole.height) / cell_) + 1),
      cells_(size_t(columns_) * size_t(rows_)) {
  for (size_t i = 0; i < points.size(); ++i) {
    const int column = int(std::floor(points[i].px.x() / cell_)),
              row = int(std::floor(points[i].px.y() / cell_));
    if (column >= 0 && column < columns_ && row >= 0 && row < rows_)
      cells_[size_t(row * columns_ + column)].push_back(int(i));
  }
}

const CloudPoint* NearestPoint::find(const Eigen::Vector2f& px) const {
  const int column = int(std::floor(px.x() / cell_)), row = int(std::floor(px.y() / cell_));
  const CloudPoint* found = nullptr;
  float least = radius_ * radius_;
  for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x)
      for (const int i : cells_[size_t(y * columns_ + x)]) {
        const float squared = ((*points_)[size_t(i)].px - px).squaredNorm();
        if (squared < least) least = squared, found = &(*points_)[size_t(i)];
      }
  return found;
}

std::optional<CornerPose> pose_by_corners(const Pinhole& pinhole, const PlaceView& a, const PlaceView& b,
                                          PlaceEvidence* evidence) {
  const SpacePixels pairs = with_depths(pinhole, a, b);
  evidence->pairs = int(pairs.in_a.size());
  if (evidence->pairs < kMinPairs) return std::nullopt;
  const std::optional<SE3> T_b_a = pose_of(pinhole, pairs);
  if (!T_b_a) return std::nullopt;
  evidence->agreeing = count_agreeing(pinhole, pairs, *T_b_a);
  evidence->corners_log_alarms =
      log_alarms_of_corners(evidence->pairs, evidence->agreeing, chance_of_agreeing(pinhole));
  return CornerPose{*T_b_a};
}

}  // namespace edgevo
