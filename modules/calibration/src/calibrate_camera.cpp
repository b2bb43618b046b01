// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/calibrate_camera.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "coverage.h"
#include "edgevo/core/error.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// A view gives two constraints on the camera (Zhang) and its corners constrain the lens: nine parameters,
// with redundancy for bad views.
constexpr size_t kLeastViews = 8;
constexpr double kOutlier = 3;          // times the residual of the median view
constexpr double kSignificant = 3;      // standard deviations
constexpr double kMostSigmaF = 0.02;    // of f: a rotation by 90 degrees would be off by two degrees
constexpr double kMostRmsShare = 1e-3;  // of the image's width: ten times the accuracy of corners

struct Solution {
  cv::Mat K, lens, sigmas;
  std::vector<cv::Mat> rotations, translations;
  double rms = 0;
};

std::vector<std::vector<cv::Point2f>> image_points(const std::vector<BoardView>& views) {
  std::vector<std::vector<cv::Point2f>> points(views.size());
  for (size_t v = 0; v < views.size(); ++v)
    for (const Eigen::Vector2f& p : views[v].px) points[v].emplace_back(p.x(), p.y());
  return points;
}

std::vector<std::vector<cv::Point3f>> board_points(const std::vector<BoardView>& views) {
  std::vector<std::vector<cv::Point3f>> points(views.size());
  for (size_t v = 0; v < views.size(); ++v)
    for (const Eigen::Vector2f& p : views[v].p_board) points[v].emplace_back(p.x(), p.y(), 0.f);
  return points;
}

Solution solve_with(const std::vector<BoardView>& views, const BoardViews& all, int flags) {
  Solution s;
  cv::Mat sigmas_of_poses, rms_of_views;
  s.rms = cv::calibrateCamera(board_points(views), image_points(views), {all.width, all.height}, s.K, s.lens,
                              s.rotations, s.translations, s.sigmas, sigmas_of_poses, rms_of_views, flags);
  return s;
}

double sigma(const Solution& s, int i) { return s.sigmas.at<double>(i); }

// OpenCV's order: fx fy cx cy k1 k2 p1 p2 k3.
Solution solve(const std::vector<BoardView>& views, const BoardViews& all) {
  constexpr int kK3 = 4, kSigmaOfK3 = 8;
  Solution full = solve_with(views, all, 0);
  if (std::abs(full.lens.at<double>(kK3)) > kSignificant * sigma(full, kSigmaOfK3)) return full;
  return solve_with(views, all, cv::CALIB_FIX_K3);
}

Camera camera_of(const Solution& s, const BoardViews& all) {
  const auto K = [&](int row, int column) { return s.K.at<double>(row, column); };
  const auto k = [&](int i) { return s.lens.at<double>(i); };
  Camera camera;
  camera.set_pinhole({K(0, 0), K(1, 1), K(0, 2), K(1, 2), all.width, all.height});
  camera.set_distortion({k(0), k(1), k(2), k(3), k(4)});
  return camera;
}

ViewFit fit_of(const BoardView& view, const Solution& s, size_t i) {
  ViewFit fit{view.frame, 0, view.px, {}, Eigen::Vector3d::UnitZ()};
  std::vector<cv::Point2f> projected;
  cv::projectPoints(board_points({view}).front(), s.rotations[i], s.translations[i], s.K, s.lens, projected);
  double squares = 0;
  for (size_t c = 0; c < projected.size(); ++c) {
    fit.residual_px.push_back(view.px[c] - Eigen::Vector2f(projected[c].x, projected[c].y));
    squares += double(fit.residual_px.back().squaredNorm());
  }
  fit.rms_px = std::sqrt(squares / double(projected.size()));
  cv::Matx33d R;
  cv::Rodrigues(s.rotations[i], R);
  fit.normal_cam = Eigen::Vector3d(R(0, 2), R(1, 2), R(2, 2));
  if (fit.normal_cam.z() < 0) fit.normal_cam = -fit.normal_cam;
  return fit;
}

std::vector<ViewFit> fits_of(const std::vector<BoardView>& views, const Solution& s) {
  std::vector<ViewFit> fits;
  for (size_t i = 0; i < views.size(); ++i) fits.push_back(fit_of(views[i], s, i));
  return fits;
}

// The views without the outliers; all of them if too few would remain.
std::vector<BoardView> without_outliers(const std::vector<BoardView>& views, const Solution& s,
                                        std::vector<int>* skipped) {
  std::vector<double> rms;
  for (const ViewFit& fit : fits_of(views, s)) rms.push_back(fit.rms_px);
  const double most = kOutlier * quantile(rms, 0.5);
  std::vector<BoardView> kept;
  for (size_t i = 0; i < views.size(); ++i)
    if (rms[i] <= most) kept.push_back(views[i]);
  if (kept.size() < kLeastViews) return views;
  for (size_t i = 0; i < views.size(); ++i)
    if (rms[i] > most) skipped->push_back(views[i].frame);
  return kept;
}

void check_count(const BoardViews& all, const std::string& where) {
  if (all.views.size() >= kLeastViews) return;
  const std::string seen = std::to_string(all.seen) + " of " + std::to_string(all.images) + " images";
  if (all.seen == 0)
    throw InputError(where, "the board is in none of " + std::to_string(all.images) + " images",
                     "check its size (of a chessboard: INNER corners), that all of it and a white border are "
                     "in view, and the light");
  throw InputError(where,
                   "the board is in " + seen + ", " + std::to_string(all.views.size()) + " different view(s)",
                   "give at least " + std::to_string(kLeastViews) +
                       ", from other directions and in other parts of the image");
}

void check_result(const CameraCalibration& c, const std::string& where) {
  const Pinhole p = c.camera.pinhole();
  const double f = std::min(p.fx, p.fy);
  if (!(c.rms_px <= kMostRmsShare * p.width))
    throw InputError(
        where, "the corners are " + fixed(c.rms_px, 2) + " px (rms) from where this lens model puts them",
        "check the board's size and that it is flat; a fisheye is not supported");
  if (!(c.sigma_f_px <= kMostSigmaF * f) || !is_tilted(c.views))
    throw InputError(where,
                     "the views do not determine the focal length (" + fixed(f, 1) + " +- " +
                         fixed(c.sigma_f_px, 1) + " px, if the tilts of the board are correct)",
                     "tilt the board by 20 to 40 degrees, to all sides");
  c.camera.check(where);
}

}  // namespace

CameraCalibration calibrate_camera(const BoardViews& all, const std::string& where) {
  check_count(all, where);
  CameraCalibration c;
  Solution s = solve(all.views, all);
  const std::vector<BoardView> views = without_outliers(all.views, s, &c.skipped);
  if (!c.skipped.empty()) s = solve(views, all);
  c.camera = camera_of(s, all);
  c.rms_px = s.rms;
  c.sigma_f_px = std::max(sigma(s, 0), sigma(s, 1));
  c.sigma_c_px = std::max(sigma(s, 2), sigma(s, 3));
  c.views = fits_of(views, s);
  check_result(c, where);
  c.lacking = what_is_lacking(c.views, all.width, all.height);
  return c;
}

}  // namespace edgevo
