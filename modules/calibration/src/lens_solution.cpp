// SPDX-License-Identifier: BSD-3-Clause
#include "lens_solution.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace edgevo {
namespace {

constexpr double kSignificant = 3;  // standard deviations
constexpr int kOfLens = 8;          // parameters of a fisheye: fx fy cx cy k1 k2 k3 k4
constexpr int kOfPose = 6;

using Corners = std::vector<std::vector<cv::Point2f>>;
using BoardCorners = std::vector<std::vector<cv::Point3f>>;

Corners image_points(const std::vector<BoardView>& views) {
  Corners points(views.size());
  for (size_t v = 0; v < views.size(); ++v)
    for (const Eigen::Vector2f& p : views[v].px) points[v].emplace_back(p.x(), p.y());
  return points;
}

std::vector<cv::Point3f> board_points(const BoardView& view) {
  std::vector<cv::Point3f> points;
  for (const Eigen::Vector2f& p : view.p_board) points.emplace_back(p.x(), p.y(), 0.f);
  return points;
}

BoardCorners board_points(const std::vector<BoardView>& views) {
  BoardCorners points;
  for (const BoardView& view : views) points.push_back(board_points(view));
  return points;
}

// ---- plumb-bob and rational ----

// In OpenCV's order fx fy cx cy k1 k2 p1 p2 k3 ...
struct PinholeSolution {
  LensSolution lens;
  cv::Mat sigmas;
};

PinholeSolution solve_pinhole(CalibratedLens kind, const std::vector<BoardView>& views, cv::Size size,
                              int flags) {
  PinholeSolution s;
  s.lens.kind = kind;
  cv::Mat sigmas_of_poses, rms_of_views;
  std::vector<cv::Mat> rotations, translations;
  s.lens.rms_px =
      cv::calibrateCamera(board_points(views), image_points(views), size, s.lens.K, s.lens.lens, rotations,
                          translations, s.sigmas, sigmas_of_poses, rms_of_views, flags);
  for (size_t i = 0; i < views.size(); ++i) {
    s.lens.rotations.emplace_back(rotations[i].at<double>(0), rotations[i].at<double>(1),
                                  rotations[i].at<double>(2));
    s.lens.translations.emplace_back(translations[i].at<double>(0), translations[i].at<double>(1),
                                     translations[i].at<double>(2));
  }
  for (int i = 0; i < 4; ++i) s.lens.sigmas[i] = s.sigmas.at<double>(i);
  return s;
}

// Without k3 where it is not significant.
LensSolution solve_plumb_bob(const std::vector<BoardView>& views, cv::Size size) {
  constexpr int kK3 = 4, kSigmaOfK3 = 8;
  const PinholeSolution full = solve_pinhole(CalibratedLens::kPlumbBob, views, size, 0);
  if (std::abs(full.lens.lens.at<double>(kK3)) > kSignificant * full.sigmas.at<double>(kSigmaOfK3))
    return full.lens;
  return solve_pinhole(CalibratedLens::kPlumbBob, views, size, cv::CALIB_FIX_K3).lens;
}

// ---- fisheye ----

// Standard deviations of the parameters of the lens, which OpenCV does not give: the normal equations without
// the poses. Columns of OpenCV's Jacobian: fx fy cx cy k1 k2 k3 k4, rotation, translation, skew.
cv::Vec4d fisheye_sigmas(const LensSolution& s, const std::vector<BoardView>& views) {
  cv::Mat normal = cv::Mat::zeros(kOfLens, kOfLens, CV_64F);
  double squares = 0, count = 0;
  for (size_t i = 0; i < views.size(); ++i) {
    std::vector<cv::Point3d> board;
    for (const cv::Point3f& p : board_points(views[i])) board.emplace_back(p);
    std::vector<cv::Point2d> projected;
    cv::Mat J;
    cv::fisheye::projectPoints(board, projected, s.rotations[i], s.translations[i], s.K, s.lens, 0, J);
    const cv::Mat lens = J.colRange(0, kOfLens), pose = J.colRange(kOfLens, kOfLens + kOfPose);
    cv::Mat inverse;
    cv::invert(pose.t() * pose, inverse, cv::DECOMP_SVD);
    normal += lens.t() * lens - lens.t() * pose * inverse * pose.t() * lens;
    for (size_t c = 0; c < board.size(); ++c)
      squares += std::pow(double(views[i].px[c].x()) - projected[c].x, 2) +
                 std::pow(double(views[i].px[c].y()) - projected[c].y, 2);
    count += 2.0 * double(board.size());
  }
  cv::Mat covariance;
  cv::invert(normal, covariance, cv::DECOMP_SVD);
  const double variance = squares / std::max(1.0, count - kOfLens - kOfPose * double(views.size()));
  cv::Vec4d sigmas;
  for (int i = 0; i < 4; ++i) sigmas[i] = std::sqrt(std::max(0.0, variance * covariance.at<double>(i, i)));
  return sigmas;
}

LensSolution solve_fisheye_from(cv::Mat K, const std::vector<BoardView>& views, cv::Size size) {
  LensSolution s;
  s.kind = CalibratedLens::kFisheye;
  s.K = std::move(K);
  s.lens = cv::Mat::zeros(4, 1, CV_64F);
  const int flags = cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW |
                    cv::fisheye::CALIB_USE_INTRINSIC_GUESS;
  s.rms_px = cv::fisheye::calibrate(board_points(views), image_points(views), size, s.K, s.lens, s.rotations,
                                    s.translations, flags);
  s.sigmas = fisheye_sigmas(s, views);
  return s;
}

// From several views of the whole image: from the wrong one the adjustment may end elsewhere.
std::optional<LensSolution> solve_fisheye(const std::vector<BoardView>& views, cv::Size size) {
  std::optional<LensSolution> best;
  for (const double view : {M_PI, 2.1, 1.2}) {
    const double f = std::max(size.width, size.height) / view;
    try {
      LensSolution s = solve_fisheye_from(
          (cv::Mat_<double>(3, 3) << f, 0, size.width / 2.0 - 0.5, 0, f, size.height / 2.0 - 0.5, 0, 0, 1),
          views, size);
      if (std::isfinite(s.rms_px) && (!best || s.rms_px < best->rms_px)) best = std::move(s);
    } catch (const cv::Exception&) {  // its equations have no solution
    }
  }
  return best;
}

bool shows_all_corners(const Camera& camera, const std::vector<BoardView>& views) {
  for (const BoardView& view : views)
    for (const Eigen::Vector2f& px : view.px)
      if (!camera.unproject(px.cast<double>())) return false;
  return true;
}

std::optional<LensSolution> solve(CalibratedLens kind, const std::vector<BoardView>& views, cv::Size size) {
  if (kind == CalibratedLens::kFisheye) return solve_fisheye(views, size);
  if (kind == CalibratedLens::kPlumbBob) return solve_plumb_bob(views, size);
  return solve_pinhole(kind, views, size, cv::CALIB_RATIONAL_MODEL).lens;
}

}  // namespace

Camera LensSolution::camera(int width, int height) const {
  const auto k = [&](int i) { return lens.at<double>(i); };
  Camera camera;
  if (kind == CalibratedLens::kFisheye)
    camera.model = KannalaBrandtModel{{}, k(0), k(1), k(2), k(3)};
  else if (kind == CalibratedLens::kRational)
    camera.model = RationalModel{{}, {{k(0), k(1), k(2), k(3), k(4)}, k(5), k(6), k(7), 0, 0, 0, 0}};
  else
    camera.set_distortion({k(0), k(1), k(2), k(3), k(4)});
  camera.set_pinhole(
      {K.at<double>(0, 0), K.at<double>(1, 1), K.at<double>(0, 2), K.at<double>(1, 2), width, height});
  return camera;
}

std::vector<cv::Point2d> LensSolution::project(const BoardView& view, size_t i) const {
  std::vector<cv::Point2f> projected;
  if (kind == CalibratedLens::kFisheye)
    cv::fisheye::projectPoints(board_points(view), projected, rotations[i], translations[i], K, lens);
  else
    cv::projectPoints(board_points(view), rotations[i], translations[i], K, lens, projected);
  return {projected.begin(), projected.end()};
}

int LensSolution::parameters() const {
  if (kind == CalibratedLens::kFisheye) return 8;
  return kind == CalibratedLens::kRational ? 12 : 9;
}

std::optional<LensSolution> solve_lens(CalibratedLens kind, const std::vector<BoardView>& views, int width,
                                       int height) {
  try {
    std::optional<LensSolution> s = solve(kind, views, {width, height});
    if (!s || !shows_all_corners(s->camera(width, height), views)) return std::nullopt;
    return s;
  } catch (const cv::Exception&) {  // its equations have no solution
    return std::nullopt;
  }
}

}  // namespace edgevo
