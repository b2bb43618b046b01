// SPDX-License-Identifier: BSD-3-Clause
#include "corner_pose.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <utility>

#include "differing_bits.h"
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
constexpr float kDistinct = 0.9F;
constexpr int kMaxPairBits = 80;
// Corners agree with a pose within so many pixels: the place of a descriptor, and what its depth is off by.
constexpr float kAgreePx = 4;
// The most samples for one pair of views, some 10 ms.
constexpr int kMaxTries = 1000;
// Cells that points are looked up in, pixels: some ten thousand in an image.
constexpr float kMinCell = 8;
// That a sample without a wrong pair is among them.
constexpr double kConfidence = 0.999;

// The most alike of the other view, so far.
struct MostAlike {
  int bits = 257, next_bits = 257;  // and those of the second one
  size_t index = 0;

  void compare(int other_bits, size_t other) {
    if (other_bits < bits)
      next_bits = bits, bits = other_bits, index = other;
    else
      next_bits = std::min(next_bits, other_bits);
  }
};

// Indices in the two views of those that are most alike in both directions, and unmistakable in the first.
// Both directions at once: a tenth of the time of OpenCV's matcher.
std::vector<std::pair<size_t, size_t>> pairs_alike(const ViewCorners& a, const ViewCorners& b) {
  std::vector<MostAlike> there(a.descriptors.size()), back(b.descriptors.size());
  for (size_t i = 0; i < there.size(); ++i)
    for (size_t j = 0; j < back.size(); ++j) {
      const int bits = differing_bits(a.descriptors[i], b.descriptors[j]);
      there[i].compare(bits, j), back[j].compare(bits, i);
    }
  std::vector<std::pair<size_t, size_t>> pairs;
  for (size_t i = 0; i < there.size(); ++i) {
    const MostAlike& m = there[i];
    const bool is_distinct = m.bits <= kMaxPairBits && float(m.bits) <= kDistinct * float(m.next_bits);
    if (is_distinct && m.next_bits <= 256 && back[m.index].index == i) pairs.emplace_back(i, m.index);
  }
  return pairs;
}

struct SpacePixels {
  std::vector<cv::Point3d> in_a;  // points in the frame of view a
  std::vector<cv::Point2d> in_b;  // where view b shows them
};

SpacePixels with_depths(const Pinhole& pinhole, const PlaceView& a, const RememberedView& b) {
  const NearestPoint nearest(pinhole, a.points, kNearPx);
  SpacePixels found;
  for (const auto& [in_a, in_b] : pairs_alike(a.view.corners, b.corners)) {
    const Eigen::Vector2f& px = a.view.corners.px[in_a];
    const CloudPoint* point = nearest.find(px);
    if (!point || !(point->idepth > 0) || point->idepth_sigma > kMaxRelativeSigma * point->idepth) continue;
    const Eigen::Vector3d X = pinhole.ray(px.cast<double>()) / point->idepth;
    const Eigen::Vector2f& seen = b.corners.px[in_b];
    found.in_a.emplace_back(X.x(), X.y(), X.z()), found.in_b.emplace_back(seen.x(), seen.y());
  }
  return found;
}

// That most agree with, of those by three corners; then the one that fits these best.
std::optional<SE3> pose_of(const Pinhole& pinhole, const SpacePixels& pairs, int tries) {
  const cv::Mat K = camera_matrix(pinhole);
  cv::Mat turn, t, R, agreeing;
  if (!cv::solvePnPRansac(pairs.in_a, pairs.in_b, K, cv::noArray(), turn, t, false, tries, kAgreePx,
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

// Samples that find a pose which so many corners agree with as prove it, if there is one; 0: not even all
// would. With the share w of right ones and OpenCV's samples of four, 1 - (1 - w^4)^tries is the confidence.
int tries_for(int pairs, double chance) {
  int proof = 4;
  while (proof <= pairs && log_alarms_of_corners(pairs, proof, chance) > kLogProof) ++proof;
  if (proof > pairs) return 0;
  const double share = double(proof) / pairs;
  if (proof == pairs) return 1;
  return int(
      std::min<double>(kMaxTries, std::ceil(std::log(1 - kConfidence) / std::log(1 - std::pow(share, 4)))));
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

std::optional<CornerPose> pose_by_corners(const Pinhole& pinhole, const PlaceView& a, const RememberedView& b,
                                          PlaceEvidence* evidence) {
  const SpacePixels pairs = with_depths(pinhole, a, b);
  evidence->pairs = int(pairs.in_a.size());
  const double chance = chance_of_agreeing(pinhole);
  const int tries = tries_for(evidence->pairs, chance);
  if (tries == 0) return std::nullopt;
  const std::optional<SE3> T_b_a = pose_of(pinhole, pairs, tries);
  if (!T_b_a) return std::nullopt;
  evidence->agreeing = count_agreeing(pinhole, pairs, *T_b_a);
  evidence->corners_log_alarms = log_alarms_of_corners(evidence->pairs, evidence->agreeing, chance);
  return CornerPose{*T_b_a};
}

}  // namespace edgevo
