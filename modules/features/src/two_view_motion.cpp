// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/two_view_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>

#include "edgevo/bundle_adjustment/epipolar_lines.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/robust.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/opencv_bridge/opencv_pose.h"
#include "motion_of_essential.h"

namespace edgevo {
namespace {

// Most steps of Gauss-Newton.
constexpr int kRefineIterations = 10;
// Length of a last step, in radians and components of unit vectors: far below what pixels can resolve.
constexpr double kConverged = 1e-9;
// Probability that a RANSAC run draws at least one sample of five right corners; the other runs find what it
// misses.
constexpr double kConfidence = 0.999;
// Distance from a plane's homography, times that of the essential matrix: corners near a plane count, too.
constexpr double kPlanePx = 3;
using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

// Two unit vectors that span the plane perpendicular to t.
Eigen::Matrix<double, 3, 2> tangent_plane(const Eigen::Vector3d& t) {
  const Eigen::Vector3d a = t.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> B;
  B << a, t.cross(a).normalized();
  return B;
}

// Distance of the ray y from the epipolar line of x, on the image plane z = 1 of the last view.
double epipolar_distance(const SE3& T, const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  const Eigen::Vector3d line = T.translation().cross(T.rotation() * x);
  return line.dot(y) / std::max(line.head<2>().norm(), kMinLineLength);
}

// Computes median error and parallax over all corners.
void measure(const std::vector<Eigen::Vector3d>& first, const std::vector<Eigen::Vector3d>& last,
             double focal_px, TwoViewMotion* m) {
  std::vector<double> errors, angles;
  for (size_t i = 0; i < first.size(); ++i) {
    errors.push_back(focal_px * std::abs(epipolar_distance(m->T_last_first, first[i], last[i])));
    angles.push_back(angle_between(m->T_last_first.rotation() * first[i], last[i]));
  }
  m->median_error_px = median(std::move(errors));
  m->parallax_rad = median(std::move(angles));
}

// Distance of two rays from fitting a motion, pixels, spread over both images to first order (Sampson).
double sampson_distance(const SE3& T, const Eigen::Vector3d& x, const Eigen::Vector3d& y, double focal_px) {
  const EpipolarLines lines = epipolar_lines(T, x, y);
  return focal_px * std::abs(lines.in_to.dot(y)) / lines.length;
}

// Whether the point of two rays lies in front of both views. One without parallax is far away and no evidence
// against it.
bool may_lie_in_front(const SE3& T, const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                      double min_parallax_rad) {
  const Eigen::Vector3d Rx = T.rotation() * x, normal = Rx.cross(y);
  if (angle_between(Rx, y) < min_parallax_rad) return true;
  // Signs of both depths.
  return T.translation().cross(y).dot(normal) < 0 && T.translation().cross(Rx).dot(normal) < 0;
}

std::vector<Eigen::Vector3d> rays_of(const Pinhole& pinhole, const std::vector<cv::Point2f>& corners) {
  std::vector<Eigen::Vector3d> rays;
  for (const cv::Point2f& p : corners) rays.push_back(pinhole.ray({p.x, p.y}));
  return rays;
}

void find_inliers(const SE3& T, const std::vector<Eigen::Vector3d>& first,
                  const std::vector<Eigen::Vector3d>& last, double focal_px, double ransac_px,
                  cv::Mat* inliers) {
  for (size_t i = 0; i < first.size(); ++i)
    inliers->at<uchar>(int(i)) = sampson_distance(T, first[i], last[i], focal_px) < ransac_px &&
                                 may_lie_in_front(T, first[i], last[i], ransac_px / focal_px);
}

// Motions that a homography between the views allows: two, as long as all its corners lie in front.
std::vector<SE3> motions_of_homography(const cv::Mat& H, const cv::Mat& K,
                                       const std::vector<Eigen::Vector3d>& rays_first,
                                       const cv::Mat& on_plane) {
  constexpr double kInFront = 0.9;  // of its corners: the sign of the normal is certain
  constexpr double kNoMotion = 1e-6;
  std::vector<cv::Mat> rotations, translations, normals;
  cv::decomposeHomographyMat(H, K, rotations, translations, normals);
  std::vector<SE3> motions;
  for (size_t m = 0; m < rotations.size(); ++m) {
    const Eigen::Vector3d t = to_vector(translations[m]), normal = to_vector(normals[m]);
    int all = 0, in_front = 0;
    for (size_t i = 0; i < rays_first.size(); ++i) {
      if (!on_plane.at<uchar>(int(i))) continue;
      ++all;
      in_front += normal.dot(rays_first[i]) > 0;
    }
    if (t.norm() > kNoMotion && in_front > kInFront * all)
      motions.push_back(to_se3(rotations[m], t.normalized()));
  }
  return motions;
}

// Refines the motion of a five-corner sample over all corners that agree with it, found anew in each round:
// the more agree, the less depends on the sample.
SE3 refine_over_inliers(SE3 T, const std::vector<Eigen::Vector3d>& first,
                        const std::vector<Eigen::Vector3d>& last, double focal_px, double ransac_px,
                        cv::Mat* inliers, const TurnOfViews* turn) {
  constexpr int kRounds = 3;  // as measured: lab 2026-11-22_bootstrap
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Eigen::Vector3d> x, y;
    for (size_t i = 0; i < first.size(); ++i) {
      if (!inliers->at<uchar>(int(i))) continue;
      x.push_back(first[i]);
      y.push_back(last[i]);
    }
    T = refine_motion(T, x, y, focal_px, 0.5 * ransac_px, turn);
    find_inliers(T, first, last, focal_px, ransac_px, inliers);
  }
  return T;
}

// A motion refined from a start, over the corners that agree with it.
TwoViewMotion refined(const Pinhole& pinhole, const std::vector<cv::Point2f>& first,
                      const std::vector<cv::Point2f>& last, double ransac_px, const SE3& start,
                      cv::Mat inliers, const TurnOfViews* turn = nullptr) {
  const std::vector<Eigen::Vector3d> rays_first = rays_of(pinhole, first), rays_last = rays_of(pinhole, last);
  TwoViewMotion m;
  m.inliers = std::move(inliers);
  m.T_last_first = refine_over_inliers(start, rays_first, rays_last, pinhole.fx, ransac_px, &m.inliers, turn);
  measure(rays_first, rays_last, pinhole.fx, &m);
  return m;
}

}  // namespace

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

SE3 refine_motion(const SE3& T_last_first, const std::vector<Eigen::Vector3d>& rays_first,
                  const std::vector<Eigen::Vector3d>& rays_last, double focal_px, double huber_px,
                  const TurnOfViews* turn) {
  SE3 T = T_last_first;
  for (int iteration = 0; iteration < kRefineIterations; ++iteration) {
    const Eigen::Vector3d t = T.translation();
    const Eigen::Matrix<double, 3, 2> B = tangent_plane(t);
    Matrix5d H = Matrix5d::Zero();
    Vector5d b = Vector5d::Zero();
    for (size_t i = 0; i < rays_first.size(); ++i) {
      const Eigen::Vector3d Rx = T.rotation() * rays_first[i], &y = rays_last[i];
      const Eigen::Vector3d line = t.cross(Rx);
      // Fixed during a step.
      const double scale = focal_px / std::max(line.head<2>().norm(), kMinLineLength);
      const double r = scale * line.dot(y);
      Vector5d J;
      J << scale * Rx.cross(y.cross(t)), scale * B.transpose() * Rx.cross(y);
      const double w = huber_weight(r, huber_px);
      H.noalias() += w * J * J.transpose();
      b.noalias() += w * r * J;
    }
    if (turn) {
      const Eigen::Matrix3d information = huber_px * huber_px * turn->information;
      H.topLeftCorner<3, 3>() += information;
      b.head<3>() += information * rotation_vector(T.rotation() * turn->R_last_first.conjugate());
    }
    // Keeps the matrix invertible where an unknown is not constrained.
    H.diagonal().array() += 1e-9 * (H.trace() + 1e-9);
    const Vector5d step = -H.ldlt().solve(b);
    if (!step.allFinite()) break;
    Vector6d rotation = Vector6d::Zero();
    rotation.tail<3>() = step.head<3>();
    T = SE3(SE3::exp(rotation).rotation() * T.rotation(), (t + B * step.tail<2>()).normalized());
    if (step.norm() < kConverged) break;
  }
  return T;
}

std::vector<TwoViewMotion> estimate_motions(const Pinhole& pinhole, const std::vector<cv::Point2f>& first,
                                            const std::vector<cv::Point2f>& last, double ransac_px,
                                            int trials, Random* random) {
  const cv::Mat K = camera_matrix(pinhole);
  std::vector<TwoViewMotion> motions;
  std::vector<int> order(first.size());
  std::iota(order.begin(), order.end(), 0);
  for (int trial = 0; trial < trials; ++trial) {
    for (size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random->below(int(k))]);
    std::vector<cv::Point2f> from, to;
    for (int i : order) from.push_back(first[i]), to.push_back(last[i]);
    cv::Mat found, R, t;
    const cv::Mat E = cv::findEssentialMat(from, to, K, cv::RANSAC, kConfidence, ransac_px, found);
    if (E.rows != 3) continue;
    motion_of_essential(E, from, to, K, &R, &t, &found);
    cv::Mat inliers = cv::Mat::zeros(int(first.size()), 1, CV_8U);
    for (size_t k = 0; k < order.size(); ++k) inliers.at<uchar>(order[k]) = found.at<uchar>(int(k)) != 0;
    motions.push_back(
        refined(pinhole, first, last, ransac_px, to_se3(R, to_vector(t).normalized()), inliers));
  }
  return motions;
}

std::vector<TwoViewMotion> estimate_motions_of_plane(const Pinhole& pinhole,
                                                     const std::vector<cv::Point2f>& first,
                                                     const std::vector<cv::Point2f>& last, double ransac_px) {
  cv::Mat on_plane;
  const cv::Mat H = cv::findHomography(first, last, cv::RANSAC, kPlanePx * ransac_px, on_plane);
  std::vector<TwoViewMotion> motions;
  if (H.rows != 3) return motions;
  for (const SE3& T : motions_of_homography(H, camera_matrix(pinhole), rays_of(pinhole, first), on_plane)) {
    motions.push_back(refined(pinhole, first, last, ransac_px, T, on_plane.clone()));
    motions.back().model = "plane";
  }
  return motions;
}

bool TurnOfViews::contradicts(const Eigen::Quaterniond& R) const {
  constexpr double kSigmas = 3;
  const Eigen::Vector3d off = rotation_vector(R * R_last_first.conjugate());
  return off.dot(information * off) > kSigmas * kSigmas;
}

// Both rays of a corner and the translation lie in one plane: t is across the normals of two of them.
std::optional<TwoViewMotion> estimate_motion_with_turn(const Pinhole& pinhole,
                                                       const std::vector<cv::Point2f>& first,
                                                       const std::vector<cv::Point2f>& last, double ransac_px,
                                                       const TurnOfViews& turn, Random* random) {
  constexpr int kTrials =
      50;  // of which one has two right corners if half of all are wrong: all but 1 in 10^6
  const std::vector<Eigen::Vector3d> x = rays_of(pinhole, first), y = rays_of(pinhole, last);
  const auto normal = [&](int i) {
    return Eigen::Vector3d((turn.R_last_first * x[size_t(i)]).cross(y[size_t(i)]));
  };
  cv::Mat inliers = cv::Mat::zeros(int(first.size()), 1, CV_8U), best;
  SE3 start;
  int most = 0;
  for (int trial = 0; trial < kTrials && first.size() > 1; ++trial) {
    const int i = random->below(int(first.size())), j = random->below(int(first.size()));
    const Eigen::Vector3d t = normal(i).cross(normal(j));
    if (t.norm() < kMinLineLength * kMinLineLength) continue;
    for (const double sign : {1.0, -1.0}) {
      const SE3 T(turn.R_last_first, sign * t.normalized());
      find_inliers(T, x, y, pinhole.fx, ransac_px, &inliers);
      if (const int count = cv::countNonZero(inliers); count > most)
        most = count, start = T, best = inliers.clone();
    }
  }
  if (most == 0) return std::nullopt;
  TwoViewMotion m = refined(pinhole, first, last, ransac_px, start, best, &turn);
  m.model = "a known turn";
  return m;
}

TwoViewMotion refined_motion(const Pinhole& pinhole, const std::vector<cv::Point2f>& first,
                             const std::vector<cv::Point2f>& last, double ransac_px, const SE3& start,
                             const TurnOfViews* turn) {
  return refined(pinhole, first, last, ransac_px, start,
                 measure_motion(pinhole, first, last, ransac_px, start).inliers, turn);
}

TwoViewMotion measure_motion(const Pinhole& pinhole, const std::vector<cv::Point2f>& first,
                             const std::vector<cv::Point2f>& last, double ransac_px,
                             const SE3& T_last_first) {
  const std::vector<Eigen::Vector3d> rays_first = rays_of(pinhole, first), rays_last = rays_of(pinhole, last);
  TwoViewMotion m;
  m.T_last_first = T_last_first;
  m.inliers = cv::Mat::zeros(int(first.size()), 1, CV_8U);
  find_inliers(T_last_first, rays_first, rays_last, pinhole.fx, ransac_px, &m.inliers);
  measure(rays_first, rays_last, pinhole.fx, &m);
  return m;
}

std::vector<TwoViewMotion> without_repeats(std::vector<TwoViewMotion> motions) {
  constexpr double kSameShare = 0.02;  // of the parallax
  constexpr double kSameDirection = 0.05;
  std::vector<TwoViewMotion> distinct;
  for (TwoViewMotion& m : motions)
    if (std::none_of(distinct.begin(), distinct.end(), [&](const TwoViewMotion& d) {
          return (d.T_last_first.translation() - m.T_last_first.translation()).norm() < kSameDirection &&
                 (d.T_last_first * m.T_last_first.inverse()).angle() < kSameShare * d.parallax_rad;
        }))
      distinct.push_back(std::move(m));
  return distinct;
}

bool disagree(const SE3& a, const SE3& b, double parallax_rad) {
  constexpr double kMaxRotationShare = 0.25;  // of the parallax: depths would be wrong by as much
  return (a * b.inverse()).angle() > kMaxRotationShare * parallax_rad;
}

bool is_ambiguous(const TwoViewMotion& best, const std::vector<TwoViewMotion>& motions) {
  constexpr double kFitsToo = 1.5;  // times the best median error: it cannot distinguish them
  return std::any_of(motions.begin(), motions.end(), [&](const TwoViewMotion& m) {
    return m.median_error_px < kFitsToo * best.median_error_px &&
           disagree(m.T_last_first, best.T_last_first, std::min(m.parallax_rad, best.parallax_rad));
  });
}

}  // namespace edgevo
