// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/view_link.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

#include "edgevo/core/order_statistics.h"
#include "edgevo/features/two_view_motion.h"
#include "edgevo/opencv_bridge/opencv_pose.h"
#include "motion_of_essential.h"

namespace edgevo {

struct ViewFeatures {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

namespace {

constexpr int kMaxFeatures = 4000;
// Best distance over second best of a match that is unmistakable.
constexpr float kDistinct = 0.85F;
constexpr double kRansacPx = 1.0, kLinkConfidence = 0.999;
constexpr size_t kMinMatches = 30;
constexpr int kMinAgreeing = 25;
// Features with a depth on each side, at least: a median of fewer means little.
constexpr size_t kMinDepths = 8;
// A feature has the depth of the nearest map point within so many pixels.
constexpr float kNearPx = 6;
constexpr double kMaxRelativeSigma = 0.5;
// Parallax of a feature from which its triangulated depth counts: ten times the noise of a match.
constexpr double kMinParallaxPx = 5;
// Depths that share their map have common errors: no more certain than this.
constexpr double kMinSigma = 0.02, kMaxSigma = 0.15;
// A bent map still knows its unit better than equal speed does, whose logarithm is off by this.
constexpr double kMaxBend = 0.5;

ViewFeatures find_features(const FramePyramid& pyramid) {
  const Plane<uint8_t>& gray = pyramid.finest().gray;
  const cv::Mat image(gray.height(), gray.width(), CV_8U, const_cast<uint8_t*>(gray.row(0)));
  ViewFeatures found;
  const cv::Ptr<cv::SIFT> sift = cv::SIFT::create(kMaxFeatures);
  sift->detect(image, found.points);
  const auto is_ego = [&](const cv::KeyPoint& k) { return pyramid.is_ego(k.pt.x, k.pt.y); };
  found.points.erase(std::remove_if(found.points.begin(), found.points.end(), is_ego), found.points.end());
  sift->compute(image, found.points, found.descriptors);
  return found;
}

// Distinct matches of each row of `a` in `b`; -1: none.
std::vector<int> nearest(const cv::Mat& a, const cv::Mat& b) {
  std::vector<std::vector<cv::DMatch>> found;
  cv::BFMatcher(cv::NORM_L2).knnMatch(a, b, found, 2);
  std::vector<int> match(size_t(a.rows), -1);
  for (const std::vector<cv::DMatch>& m : found)
    if (m.size() == 2 && m[0].distance < kDistinct * m[1].distance)
      match[size_t(m[0].queryIdx)] = m[0].trainIdx;
  return match;
}

Eigen::Vector2f pixel(const cv::KeyPoint& k) { return {k.pt.x, k.pt.y}; }

// Those that hold in both directions. The way back, as much work as the way there, is searched for them
// alone.
MatchedPixels match_features(const ViewFeatures& a, const ViewFeatures& b) {
  MatchedPixels matches;
  if (a.points.size() < kMinMatches || b.points.size() < kMinMatches) return matches;
  const std::vector<int> to_b = nearest(a.descriptors, b.descriptors);
  std::vector<size_t> found;  // in a
  cv::Mat ends;               // descriptors in b
  for (size_t i = 0; i < to_b.size(); ++i) {
    if (to_b[i] < 0) continue;
    found.push_back(i);
    ends.push_back(b.descriptors.row(to_b[i]));
  }
  if (found.empty()) return matches;
  const std::vector<int> back = nearest(ends, a.descriptors);
  for (size_t k = 0; k < found.size(); ++k)
    if (back[k] == int(found[k])) {
      matches.a.push_back(pixel(a.points[found[k]]));
      matches.b.push_back(pixel(b.points[size_t(to_b[found[k]])]));
    }
  return matches;
}

// Depth of the nearest point of the map and its relative standard deviation; depth 0: none is near.
struct Depth {
  double value = 0, sigma = 0;
};
Depth depth_at(const Eigen::Vector2f& px, const std::vector<CloudPoint>& cloud) {
  float least = kNearPx * kNearPx;
  Depth depth;
  for (const CloudPoint& p : cloud) {
    if (p.host_keyframe < 0 || !(p.idepth > 0) || p.idepth_sigma > kMaxRelativeSigma * p.idepth) continue;
    const float distance = (p.px - px).squaredNorm();
    if (distance < least) least = distance, depth = {1 / p.idepth, p.idepth_sigma / p.idepth};
  }
  return depth;
}

// Logarithm of a ratio of lengths, and the standard deviation of the depth that it is made of.
struct Sample {
  double log = 0, sigma = 0;
};

// The logarithms of certain depths, or of the most certain ones if there are few: uncertain ones are those
// far away, whose errors lean to one side.
std::vector<double> certain_ones(std::vector<Sample> samples) {
  constexpr double kCertain = 0.1;
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.sigma < b.sigma; });
  std::vector<double> logs;
  for (const Sample& s : samples)
    if (s.sigma < kCertain || logs.size() < kMinDepths) logs.push_back(s.log);
  return logs;
}

// Median of logarithms with its standard deviation.
struct LogRatio {
  double log = 0, sigma = 0;
  size_t count = 0;
};
std::optional<LogRatio> median_ratio(std::vector<Sample> samples) {
  const std::vector<double> logs = certain_ones(std::move(samples));
  if (logs.size() < kMinDepths) return std::nullopt;
  const double middle = median(logs);
  std::vector<double> off;
  for (const double x : logs) off.push_back(std::abs(x - middle));
  const double spread = 1.4826 * median(std::move(off));  // a standard deviation, of normal errors
  const double sigma = 1.2533 * spread / std::sqrt(double(logs.size()));  // of a median
  return LogRatio{middle, std::max(sigma, kMinSigma), logs.size()};
}

// A feature that agrees with the motion.
struct Feature {
  Eigen::Vector3d a, b;    // rays, z = 1
  Depth depth_a, depth_b;  // in the maps
};

// Depth of a feature in view a in lengths of the motion; 0: its parallax is too small to know.
double triangulated(const Feature& f, const SE3& T_b_a, double focal_px) {
  const Eigen::Vector3d Ra = T_b_a.rotation() * f.a;
  const Eigen::Vector3d across = f.b.cross(Ra);
  const double parallax = across.norm() / (f.b.norm() * Ra.norm());
  if (focal_px * parallax < kMinParallaxPx) return 0;
  const double z = -f.b.cross(T_b_a.translation()).dot(across) / across.squaredNorm();
  return z > 0 ? z : 0;
}

// Length of the motion in the unit of each map.
struct Baselines {
  std::vector<Sample> a, b;
};
Baselines measure_baseline(const std::vector<Feature>& features, const SE3& T_b_a, double focal_px) {
  Baselines logs;
  for (const Feature& f : features) {
    const double z_a = triangulated(f, T_b_a, focal_px);
    if (!(z_a > 0)) continue;
    const double z_b = (T_b_a.rotation() * (z_a * f.a) + T_b_a.translation()).z();
    if (!(z_b > 0)) continue;
    if (f.depth_a.value > 0) logs.a.push_back({std::log(f.depth_a.value / z_a), f.depth_a.sigma});
    if (f.depth_b.value > 0) logs.b.push_back({std::log(f.depth_b.value / z_b), f.depth_b.sigma});
  }
  return logs;
}

std::optional<ViewLink> made_link(const SE3& T_b_a, double length_in_a, double log, double sigma,
                                  size_t count) {
  if (!(sigma < kMaxSigma)) return std::nullopt;
  return ViewLink{SE3(T_b_a.rotation(), length_in_a * T_b_a.translation()), std::exp(log), sigma, int(count)};
}

// Length of the motion in each map, as logarithms with their standard deviations.
struct MotionLengths {
  LogRatio a, b;
  double log_ratio() const { return a.log - b.log; }
};
std::optional<MotionLengths> motion_lengths(const std::vector<Feature>& features, const SE3& T_b_a,
                                            double focal_px) {
  const Baselines logs = measure_baseline(features, T_b_a, focal_px);
  const std::optional<LogRatio> a = median_ratio(logs.a), b = median_ratio(logs.b);
  return a && b ? std::optional(MotionLengths{*a, *b}) : std::nullopt;
}

// Difference between the ratios that two halves of the features give, logarithm; 0: one of them gives none.
template <class Key>
double difference_of_halves(std::vector<Feature> features, const SE3& T_b_a, double focal_px, Key key) {
  const auto middle = features.begin() + std::ptrdiff_t(features.size() / 2);
  std::nth_element(features.begin(), middle, features.end(),
                   [&](const Feature& f, const Feature& g) { return key(f) < key(g); });
  const auto first = motion_lengths({features.begin(), middle}, T_b_a, focal_px),
             second = motion_lengths({middle, features.end()}, T_b_a, focal_px);
  return first && second ? std::abs(first->log_ratio() - second->log_ratio()) : 0.0;
}

// A young map can be bent. Its depths have a common error then, which no spread shows: it differs between
// near and far, and between the sides of the view.
double bend_of_maps(std::vector<Feature> features, const SE3& T_b_a, double focal_px) {
  features.erase(std::remove_if(features.begin(), features.end(),
                                [&](const Feature& f) { return triangulated(f, T_b_a, focal_px) == 0; }),
                 features.end());
  const auto depth = [&](const Feature& f) { return triangulated(f, T_b_a, focal_px); };
  const auto across = [](const Feature& f) { return f.a.x(); };
  return std::max(difference_of_halves(features, T_b_a, focal_px, depth),
                  difference_of_halves(features, T_b_a, focal_px, across));
}

std::optional<ViewLink> link_by_baseline(const std::vector<Feature>& features, const SE3& T_b_a,
                                         double focal_px, const MotionLengths& lengths) {
  const LogRatio &a = lengths.a, &b = lengths.b;
  std::optional<ViewLink> link = made_link(T_b_a, std::exp(a.log), lengths.log_ratio(),
                                           std::hypot(a.sigma, b.sigma), std::min(a.count, b.count));
  const double bend = bend_of_maps(features, T_b_a, focal_px);
  if (!link || bend > kMaxBend) return std::nullopt;
  link->sigma = std::max(link->sigma, bend);
  return link;
}

// The camera has hardly moved against the depth: the depths of one view are those of the other.
std::optional<ViewLink> link_by_depths(const std::vector<Feature>& features, const SE3& T_b_a) {
  std::vector<Sample> logs;
  for (const Feature& f : features) {
    const double z = f.depth_a.value * (T_b_a.rotation() * f.a).z();
    if (z > 0 && f.depth_b.value > 0)
      logs.push_back({std::log(z / f.depth_b.value), std::hypot(f.depth_a.sigma, f.depth_b.sigma)});
  }
  const std::optional<LogRatio> ratio = median_ratio(logs);
  if (!ratio) return std::nullopt;
  return made_link(T_b_a, 0, ratio->log, ratio->sigma, ratio->count);
}

std::optional<SE3> motion_of(const Pinhole& pinhole, const MatchedPixels& matches, cv::Mat* agreeing) {
  std::vector<cv::Point2f> a, b;
  for (const Eigen::Vector2f& p : matches.a) a.emplace_back(p.x(), p.y());
  for (const Eigen::Vector2f& p : matches.b) b.emplace_back(p.x(), p.y());
  if (a.size() < kMinMatches) return std::nullopt;
  const cv::Mat K = camera_matrix(pinhole);
  cv::Mat R, t, found;
  const cv::Mat E = cv::findEssentialMat(a, b, K, cv::RANSAC, kLinkConfidence, kRansacPx, found);
  if (E.rows != 3) return std::nullopt;
  motion_of_essential(E, a, b, K, &R, &t, &found);
  const TwoViewMotion motion = refined_motion(pinhole, a, b, kRansacPx, to_se3(R, to_vector(t).normalized()));
  *agreeing = motion.inliers;
  if (cv::countNonZero(*agreeing) < kMinAgreeing) return std::nullopt;
  return motion.T_last_first;
}

}  // namespace

std::optional<ViewLink> link_views(const Pinhole& pinhole, const MatchedPixels& matches,
                                   const std::vector<CloudPoint>& a, const std::vector<CloudPoint>& b) {
  cv::Mat agreeing;
  const std::optional<SE3> T_b_a = motion_of(pinhole, matches, &agreeing);
  if (!T_b_a) return std::nullopt;
  std::vector<Feature> features;
  for (size_t i = 0; i < matches.a.size(); ++i)
    if (agreeing.at<uchar>(int(i)))
      features.push_back({pinhole.ray(matches.a[i].cast<double>()), pinhole.ray(matches.b[i].cast<double>()),
                          depth_at(matches.a[i], a), depth_at(matches.b[i], b)});
  // Depths are those of one place only if there is no baseline to measure.
  const std::optional<MotionLengths> lengths = motion_lengths(features, *T_b_a, pinhole.fx);
  return lengths ? link_by_baseline(features, *T_b_a, pinhole.fx, *lengths)
                 : link_by_depths(features, *T_b_a);
}

LinkableView::LinkableView(const ReferenceCloud& cloud)
    : cloud_(&cloud), features_(std::make_shared<const ViewFeatures>(find_features(*cloud.pyramid))) {}

std::optional<ViewLink> LinkableView::link_to(const Pinhole& pinhole, const LinkableView& b) const {
  return link_views(pinhole, match_features(*features_, *b.features_), cloud_->points, b.cloud_->points);
}

std::optional<ViewLink> link_views(const Pinhole& pinhole, const ReferenceCloud& a, const ReferenceCloud& b) {
  return LinkableView(a).link_to(pinhole, LinkableView(b));
}

}  // namespace edgevo
