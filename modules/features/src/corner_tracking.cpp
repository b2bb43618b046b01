// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/corner_tracking.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

// Largest distance in pixels between a corner and where it is found when followed there and back: about
// RANSAC's threshold.
constexpr double kMaxForwardBackwardPx = 0.7;
// Least quality relative to the strongest corner: low, so that corners cover the image; wrongly moving ones
// are removed later.
constexpr double kMinQuality = 0.005;
// Least distance between corners: the image's width divided by kCornersAcross, and never less than
// kMinDistancePx, to spread them over the image.
constexpr double kCornersAcross = 120, kMinDistancePx = 5.0;
constexpr int kLevels = 4;      // pyramid levels: corners are found 100 px from where the search starts
constexpr int kLevelsBack = 1;  // when following back, the start is known
// Side of the compared patch; OpenCV's default, like the next two.
constexpr int kPatchPx = 21;
constexpr int kMaxIterations = 30;
constexpr double kMinStepPx = 0.01;
// Standard deviation of a followed corner along the stronger gradient of its patch, pixels: the median
// distance from the epipolar line is 0.13 to 0.47 px, over the large motions of a walk through tiled rooms.
constexpr double kFollowedPx = 0.2;

// Products of the gradient, summed over the patch that is compared: [xx xy; xy yy]. Sobel's gradient, since
// the noise of a plain difference looks like texture along an edge.
Eigen::Matrix2d structure_tensor(const cv::Mat& image, const cv::Point2f& corner) {
  constexpr int kHalf = kPatchPx / 2;
  const cv::Rect patch(cvRound(corner.x) - kHalf, cvRound(corner.y) - kHalf, kPatchPx, kPatchPx);
  cv::Mat gx, gy;
  const cv::Mat gray = image(patch & cv::Rect(0, 0, image.cols, image.rows));
  cv::Sobel(gray, gx, CV_32F, 1, 0);
  cv::Sobel(gray, gy, CV_32F, 0, 1);
  return (Eigen::Matrix2d() << gx.dot(gx), gx.dot(gy), gx.dot(gy), gy.dot(gy)).finished();
}

// Covariance of a followed corner, S its structure tensor: C = kFollowedPx^2 lambda_max(S) S^-1, since what
// disturbs the patch (interpolation, perspective, light) grows with its gradients. Its larger root.
double weaker_sigma_px(const cv::Mat& image, const cv::Point2f& corner) {
  const Eigen::Vector2d lambda =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(structure_tensor(image, corner), Eigen::EigenvaluesOnly)
          .eigenvalues();
  return lambda[0] > 0 ? kFollowedPx * std::sqrt(lambda[1] / lambda[0])
                       : std::numeric_limits<double>::infinity();
}

}  // namespace

cv::Mat equalised(const FramePyramid& pyramid) {
  const Plane<uint8_t>& gray = pyramid.finest().gray;
  cv::Mat out;
  cv::equalizeHist(cv::Mat(gray.height(), gray.width(), CV_8U, const_cast<uint8_t*>(gray.row(0))), out);
  return out;
}

Corners find_corners(const cv::Mat& image, int count) {
  Corners corners;
  cv::goodFeaturesToTrack(image, corners, count, kMinQuality,
                          std::max(kMinDistancePx, image.cols / kCornersAcross));
  return corners;
}

void drop_own(const FramePyramid& pyramid, Corners* corners) {
  corners->erase(std::remove_if(corners->begin(), corners->end(),
                                [&](const cv::Point2f& c) { return pyramid.is_ego(c.x, c.y); }),
                 corners->end());
}

void drop_on_edges(const cv::Mat& image, double max_sigma_px, Corners* corners) {
  corners->erase(
      std::remove_if(corners->begin(), corners->end(),
                     [&](const cv::Point2f& c) { return weaker_sigma_px(image, c) > max_sigma_px; }),
      corners->end());
}

std::vector<bool> follow_corners(const cv::Mat& image_from, const cv::Mat& image_to, const Corners& from,
                                 Corners* to) {
  std::vector<bool> found(from.size());
  if (from.empty()) return found;
  const bool is_predicted = !to->empty();
  const int flags = is_predicted ? cv::OPTFLOW_USE_INITIAL_FLOW : 0;
  const cv::Size window(kPatchPx, kPatchPx);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kMaxIterations, kMinStepPx);
  std::vector<uchar> ok, ok_back;
  // The differences that are left are not needed; they cost as much as two iterations.
  cv::calcOpticalFlowPyrLK(image_from, image_to, from, *to, ok, cv::noArray(), window, kLevels, stop, flags);
  // Only what was found is followed back.
  std::vector<size_t> there;
  Corners start, back, target;
  for (size_t i = 0; i < from.size(); ++i) {
    const cv::Point2f& p = (*to)[i];
    const bool inside = p.x >= 0 && p.y >= 0 && p.x < float(image_to.cols) && p.y < float(image_to.rows);
    if (!ok[i] || !inside) continue;
    there.push_back(i);
    start.push_back(p);
    target.push_back(from[i]);
  }
  if (there.empty()) return found;
  back = target;
  cv::calcOpticalFlowPyrLK(image_to, image_from, start, back, ok_back, cv::noArray(), window,
                           is_predicted ? kLevelsBack : kLevels, stop, flags);
  for (size_t k = 0; k < there.size(); ++k)
    found[there[k]] = ok_back[k] && cv::norm(back[k] - target[k]) < kMaxForwardBackwardPx;
  return found;
}

double median_motion(size_t all, const Corners& from, const Corners& to) {
  std::vector<double> motion;
  for (size_t i = 0; i < from.size(); ++i) motion.push_back(cv::norm(to[i] - from[i]));
  const size_t left = motion.size();
  const bool some_lost = all > left;
  return of_rank(std::move(motion), some_lost ? std::min(all / 2, 3 * left / 4) : left / 2);
}

}  // namespace edgevo
