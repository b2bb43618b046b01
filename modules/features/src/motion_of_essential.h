// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The motion that an essential matrix stands for.
#include <opencv2/core.hpp>
#include <vector>

namespace edgevo {

/// Like cv::recoverPose(): of the four motions of `E` the one that sees most corners in front of both views
/// and no further than fifty baselines; `inliers`, a row for each corner, keeps only those. That triangulates
/// all corners for each motion; here the signs of the depths choose, a fortieth of the work, and only the
/// chosen motion is triangulated. Where they leave it open, cv::recoverPose() decides.
void motion_of_essential(const cv::Mat& E, const std::vector<cv::Point2f>& first,
                         const std::vector<cv::Point2f>& last, const cv::Mat& K, cv::Mat* R, cv::Mat* t,
                         cv::Mat* inliers);

}  // namespace edgevo
