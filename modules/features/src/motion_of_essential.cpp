// SPDX-License-Identifier: BSD-3-Clause
#include "motion_of_essential.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <opencv2/calib3d.hpp>

#include "edgevo/opencv_bridge/opencv_pose.h"

namespace edgevo {
namespace {

constexpr double kFarthest = 50;  // baselines, as in cv::recoverPose()
// Corners in front of the best motion over those in front of the next: the signs alone decide.
constexpr double kClearly = 2;

// One column a corner, coordinates on the image plane z = 1.
cv::Mat normalised(const std::vector<cv::Point2f>& corners, const cv::Mat& K) {
  cv::Mat points(2, int(corners.size()), CV_64F);
  for (int i = 0; i < points.cols; ++i) {
    points.at<double>(0, i) = (double(corners[size_t(i)].x) - K.at<double>(0, 2)) / K.at<double>(0, 0);
    points.at<double>(1, i) = (double(corners[size_t(i)].y) - K.at<double>(1, 2)) / K.at<double>(1, 1);
  }
  return points;
}

Eigen::Vector3d ray(const cv::Mat& points, int i) {
  return {points.at<double>(0, i), points.at<double>(1, i), 1};
}

// Signs of the depths z1, z2 of z2 y = z1 R x + t; those of -t are the opposite ones.
int inliers_in_front(const cv::Mat& R, const cv::Mat& t, const cv::Mat& a, const cv::Mat& b,
                     const cv::Mat& inliers, int* with_opposite_t) {
  const Eigen::Matrix3d rotation = to_se3(R, Eigen::Vector3d::Zero()).R();
  const Eigen::Vector3d translation = to_vector(t);
  int in_front = 0;
  *with_opposite_t = 0;
  for (int i = 0; i < a.cols; ++i) {
    if (!inliers.at<uchar>(i)) continue;
    const Eigen::Vector3d Rx = rotation * ray(a, i), y = ray(b, i), normal = Rx.cross(y);
    const double z1 = -translation.cross(y).dot(normal), z2 = -translation.cross(Rx).dot(normal);
    in_front += z1 > 0 && z2 > 0;
    *with_opposite_t += z1 < 0 && z2 < 0;
  }
  return in_front;
}

// Drops inliers that lie behind a view, or too far away.
void keep_in_front(const cv::Mat& R, const cv::Mat& t, const cv::Mat& a, const cv::Mat& b, cv::Mat* inliers) {
  const cv::Mat P1 = cv::Mat::eye(3, 4, CV_64F);
  cv::Mat P2, Q;
  cv::hconcat(R, t, P2);
  cv::triangulatePoints(P1, P2, a, b, Q);
  for (int i = 0; i < Q.cols; ++i) {
    const Eigen::Vector4d q(Q.at<double>(0, i), Q.at<double>(1, i), Q.at<double>(2, i), Q.at<double>(3, i));
    const Eigen::Vector3d p = q.head<3>() / q[3];
    const Eigen::Vector3d row(R.at<double>(2, 0), R.at<double>(2, 1), R.at<double>(2, 2));
    const double z2 = row.dot(p) + t.at<double>(2);
    const bool keep = q[2] * q[3] > 0 && p.z() < kFarthest && z2 > 0 && z2 < kFarthest;
    if (!keep) inliers->at<uchar>(i) = 0;
  }
}

}  // namespace

void motion_of_essential(const cv::Mat& E, const std::vector<cv::Point2f>& first,
                         const std::vector<cv::Point2f>& last, const cv::Mat& K, cv::Mat* R, cv::Mat* t,
                         cv::Mat* inliers) {
  cv::Mat R1, R2, direction;
  cv::decomposeEssentialMat(E, R1, R2, direction);
  const cv::Mat a = normalised(first, K), b = normalised(last, K);
  std::array<int, 4> in_front{};  // of R1 and t, R1 and -t, R2 and t, R2 and -t
  in_front[0] = inliers_in_front(R1, direction, a, b, *inliers, &in_front[1]);
  in_front[2] = inliers_in_front(R2, direction, a, b, *inliers, &in_front[3]);
  const auto best = std::max_element(in_front.begin(), in_front.end());
  const bool is_clear = std::all_of(in_front.begin(), in_front.end(),
                                    [&](const int& n) { return &n == &*best || *best > kClearly * n; });
  *R = best < in_front.begin() + 2 ? R1 : R2;
  *t = (best - in_front.begin()) % 2 == 0 ? direction : cv::Mat(-direction);
  cv::Mat near = inliers->clone();
  if (is_clear) keep_in_front(*R, *t, a, b, &near);
  // Far corners do not count there.
  if (is_clear && cv::countNonZero(near) > kClearly * (cv::countNonZero(*inliers) - *best))
    near.copyTo(*inliers);
  else
    cv::recoverPose(E, first, last, K, *R, *t, *inliers);
}

}  // namespace edgevo
