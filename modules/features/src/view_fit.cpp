// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/view_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/features/followed_corner.h"
#include "edgevo/opencv_bridge/opencv_pose.h"

namespace edgevo {
namespace {

// Depth in units of the baseline below which a triangulated corner counts as behind the camera.
constexpr double kMinCornerDepth = 1e-6;
// Inverse depth of a corner that the motion puts behind a camera, 1 / baseline: far away, it moves on from
// there.
constexpr double kFarIdepth = 1e-3;
constexpr double kMaxErrorPx = 2;  // an outlier says no more than this
constexpr int kFitIterations = 20;

Eigen::Vector3d ray_of(const Pinhole& pinhole, const cv::Point2f& px) { return pinhole.ray({px.x, px.y}); }

std::vector<double> first_idepths(const Pinhole& pinhole, const std::vector<Corners>& views,
                                  const SE3& T_last_first) {
  std::vector<double> idepths(views.front().size(), kFarIdepth);
  for (size_t i = 0; i < idepths.size(); ++i) {
    double in_first = 0, in_last = 0;
    if (triangulate(T_last_first, ray_of(pinhole, views.front()[i]), ray_of(pinhole, views.back()[i]),
                    &in_first, &in_last))
      idepths[i] = std::max(in_first, kFarIdepth);
  }
  return idepths;
}

// Poses of all views; those between are placed by PnP, else on the way from the first to the last.
std::vector<BaPose> first_poses(const Pinhole& pinhole, const std::vector<Corners>& views,
                                const std::vector<double>& idepths, const SE3& T_last_first) {
  std::vector<cv::Point3f> points;
  for (size_t i = 0; i < idepths.size(); ++i) {
    const Eigen::Vector3d p = ray_of(pinhole, views.front()[i]) / idepths[i];
    points.emplace_back(float(p.x()), float(p.y()), float(p.z()));
  }
  std::vector<BaPose> poses{{SE3(), true}};
  for (size_t v = 1; v + 1 < views.size(); ++v) {
    const SE3 on_the_way = SE3::exp(T_last_first.log() * (double(v) / double(views.size() - 1)));
    SE3 T = on_the_way;
    poses.push_back({place_view(pinhole, points, views[v], &T) ? T : on_the_way, false});
  }
  poses.push_back({T_last_first, false});
  return poses;
}

BaProblem problem_of(const Pinhole& pinhole, const std::vector<Corners>& views, const SE3& T_last_first) {
  BaProblem problem;
  problem.pinhole = pinhole;
  const std::vector<double> idepths = first_idepths(pinhole, views, T_last_first);
  problem.poses = first_poses(pinhole, views, idepths, T_last_first);
  for (size_t v = 0; v < views.size(); ++v) problem.pose_ids.push_back(int(v));
  problem.prior = ba::fix_baseline(SE3(), T_last_first, int(views.size()) - 1);
  for (size_t i = 0; i < idepths.size(); ++i) {
    problem.points.push_back({0, ray_of(pinhole, views.front()[i]), idepths[i], false});
    for (size_t v = 1; v < views.size(); ++v)
      problem.observations.push_back({int(i),
                                      int(v),
                                      {views[v][i].x, views[v][i].y},
                                      Eigen::Vector2d::UnitX(),
                                      1 / kFollowedSigmaPx,
                                      1 / kFollowedSigmaPx});
  }
  return problem;
}

double limited_rms(const BaResult& result) {
  double sum = 0;
  const size_t n = result.residual_normal_px.size();
  for (size_t k = 0; k < n; ++k) {
    const double error = std::hypot(result.residual_normal_px[k], result.residual_tangent_px[k]);
    const double counted = result.observation_valid[k] ? std::min(error, kMaxErrorPx) : kMaxErrorPx;
    sum += counted * counted;
  }
  return std::sqrt(sum / double(std::max<size_t>(n, 1)));
}

}  // namespace

bool triangulate(const SE3& T_last_first, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                 double* idepth_first, double* idepth_last) {
  // depth_b b = depth_a R a + t, least squares over the two depths.
  Eigen::Matrix<double, 3, 2> A;
  A << b, -(T_last_first.R() * a);
  const Eigen::Vector2d depth = (A.transpose() * A).ldlt().solve(A.transpose() * T_last_first.translation());
  if (!(depth.x() > kMinCornerDepth) || !(depth.y() > kMinCornerDepth)) return false;
  *idepth_last = 1.0 / depth.x();
  *idepth_first = 1.0 / depth.y();
  return true;
}

bool place_view(const Pinhole& pinhole, const std::vector<cv::Point3f>& points, const Corners& px,
                SE3* T_cam_first) {
  cv::Mat R(3, 3, CV_64F), rvec, tvec(3, 1, CV_64F);
  for (int i = 0; i < 9; ++i) R.at<double>(i / 3, i % 3) = T_cam_first->R()(i / 3, i % 3);
  for (int i = 0; i < 3; ++i) tvec.at<double>(i) = T_cam_first->translation()[i];
  cv::Rodrigues(R, rvec);
  if (!cv::solvePnP(points, px, camera_matrix(pinhole), cv::noArray(), rvec, tvec, true)) return false;
  cv::Rodrigues(rvec, R);
  *T_cam_first = to_se3(R, to_vector(tvec));
  return T_cam_first->is_finite();
}

std::optional<ViewFit> fit_views(const Pinhole& pinhole, const std::vector<Corners>& views,
                                 const SE3& T_last_first, const TurnOfViews* turn) {
  BaProblem problem = problem_of(pinhole, views, T_last_first);
  if (turn) problem.turns.push_back({0, int(views.size()) - 1, turn->R_last_first, turn->information});
  BaOptions options;
  options.max_iterations = kFitIterations;
  const BaResult result = make_bundle_adjuster("schur")->solve(&problem, options);
  if (!result.usable) return std::nullopt;
  const SE3 T = problem.poses.back().T_cam_world;
  return ViewFit{SE3(T.rotation(), T.translation().normalized()), limited_rms(result)};
}

}  // namespace edgevo
