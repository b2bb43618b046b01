// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/calibrate_camera.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <utility>

#include "coverage.h"
#include "edgevo/core/error.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "lens_solution.h"

namespace edgevo {
namespace {

// A view gives two constraints on the camera (Zhang) and its corners constrain the lens: nine parameters,
// with redundancy for bad views.
constexpr size_t kMinViews = 8;
constexpr double kOutlier = 3;         // times the residual of the median view
constexpr double kMaxSigmaF = 0.02;    // of f: a rotation by 90 degrees would be off by two degrees
constexpr double kMaxRmsShare = 1e-3;  // of the image's width: ten times the accuracy of corners

using Views = std::vector<BoardView>;

ViewFit fit_of(const BoardView& view, const LensSolution& s, size_t i) {
  ViewFit fit{view.frame, 0, view.px, {}, Eigen::Vector3d::UnitZ()};
  const std::vector<cv::Point2d> projected = s.project(view, i);
  double squares = 0;
  for (size_t c = 0; c < projected.size(); ++c) {
    fit.residual_px.push_back(view.px[c] - Eigen::Vector2f(float(projected[c].x), float(projected[c].y)));
    squares += double(fit.residual_px.back().squaredNorm());
  }
  fit.rms_px = std::sqrt(squares / double(projected.size()));
  cv::Matx33d R;
  cv::Rodrigues(s.rotations[i], R);
  fit.normal_cam = Eigen::Vector3d(R(0, 2), R(1, 2), R(2, 2));
  if (fit.normal_cam.z() < 0) fit.normal_cam = -fit.normal_cam;
  return fit;
}

std::vector<ViewFit> fits_of(const Views& views, const LensSolution& s) {
  std::vector<ViewFit> fits;
  for (size_t i = 0; i < views.size(); ++i) fits.push_back(fit_of(views[i], s, i));
  return fits;
}

// The views without the outliers; all of them if too few would remain.
Views without_outliers(const Views& views, const LensSolution& s, std::vector<int>* skipped) {
  std::vector<double> rms;
  for (const ViewFit& fit : fits_of(views, s)) rms.push_back(fit.rms_px);
  const double most = kOutlier * quantile(rms, 0.5);
  Views kept;
  for (size_t i = 0; i < views.size(); ++i)
    if (rms[i] <= most) kept.push_back(views[i]);
  if (kept.size() < kMinViews) return views;
  for (size_t i = 0; i < views.size(); ++i)
    if (rms[i] > most) skipped->push_back(views[i].frame);
  return kept;
}

void check_count(const BoardViews& all, const std::string& where) {
  if (all.views.size() >= kMinViews) return;
  const std::string seen = std::to_string(all.seen) + " of " + std::to_string(all.images) + " images";
  if (all.seen == 0)
    throw InputError(where, "the board is in none of " + std::to_string(all.images) + " images",
                     "check its size (of a chessboard: INNER corners), that all of it and a white border are "
                     "in view, and the light");
  throw InputError(where,
                   "the board is in " + seen + ", " + std::to_string(all.views.size()) + " different view(s)",
                   "give at least " + std::to_string(kMinViews) +
                       ", from other directions and in other parts of the image");
}

void check_result(const CameraCalibration& c, const std::string& where) {
  const Pinhole p = c.camera.pinhole();
  const double f = std::min(p.fx, p.fy);
  if (!(c.rms_px <= kMaxRmsShare * p.width))
    throw InputError(
        where, "the corners are " + fixed(c.rms_px, 2) + " px (rms) from where this lens model puts them",
        "check the board's size and that it is flat; a lens of a wide view may need another --model");
  if (!(c.sigma_f_px <= kMaxSigmaF * f) || !is_tilted(c.views))
    throw InputError(where,
                     "the views do not determine the focal length (" + fixed(f, 1) + " +- " +
                         fixed(c.sigma_f_px, 1) + " px, if the tilts of the board are correct)",
                     "tilt the board by 20 to 40 degrees, to all sides");
  c.camera.check(where);
}

// A lens with the views that it keeps.
struct Candidate {
  LensSolution lens;
  Views views;
  std::vector<int> skipped;
};

std::optional<Candidate> fit_lens(CalibratedLens kind, const BoardViews& all) {
  auto s = solve_lens(kind, all.views, all.width, all.height);
  if (!s) return std::nullopt;
  Candidate c{*s, {}, {}};
  c.views = without_outliers(all.views, *s, &c.skipped);
  if (c.skipped.empty()) return c;
  s = solve_lens(kind, c.views, all.width, all.height);
  if (!s) return std::nullopt;
  c.lens = *s;
  return c;
}

// Bayesian information criterion for equal views: a model with more parameters must lower the residuals by
// more than chance would, and by a twentieth, since residuals of corners are not independent.
bool is_better(const LensSolution& a, const LensSolution& b, size_t corners) {
  constexpr double kNoticeable = 0.95;
  const auto criterion = [&](const LensSolution& s) {
    const double n = 2.0 * double(corners);
    return 2 * n * std::log(std::max(s.rms_px, 1e-9)) + s.parameters() * std::log(n);
  };
  return a.rms_px < kNoticeable * b.rms_px && criterion(a) < criterion(b);
}

size_t count_corners(const Views& views) {
  size_t count = 0;
  for (const BoardView& view : views) count += view.px.size();
  return count;
}

// The models in the order of preference: the later ones must be better.
Candidate choose_lens(std::optional<CalibratedLens> kind, const BoardViews& all, const std::string& where,
                      std::vector<TriedLens>* tried) {
  std::optional<Candidate> best;
  for (const CalibratedLens k :
       {CalibratedLens::kPlumbBob, CalibratedLens::kFisheye, CalibratedLens::kRational}) {
    if (kind && *kind != k) continue;
    auto candidate = fit_lens(k, all);
    tried->push_back({k, candidate ? candidate->lens.rms_px : std::nan("")});
    if (candidate && (!best || is_better(candidate->lens, best->lens, count_corners(all.views))))
      best = std::move(candidate);
  }
  if (!best)
    throw InputError(where, "no lens model fits the corners",
                     "check the board's size, or try another --model");
  return std::move(*best);
}

}  // namespace

CameraCalibration calibrate_camera(const BoardViews& all, const std::string& where,
                                   std::optional<CalibratedLens> kind) {
  check_count(all, where);
  CameraCalibration c;
  const Candidate best = choose_lens(kind, all, where, &c.tried);
  const LensSolution& s = best.lens;
  c.skipped = best.skipped;
  c.camera = s.camera(all.width, all.height);
  c.rms_px = s.rms_px;
  c.sigma_f_px = std::max(s.sigmas[0], s.sigmas[1]);
  c.sigma_c_px = std::max(s.sigmas[2], s.sigmas[3]);
  c.views = fits_of(best.views, s);
  check_result(c, where);
  c.lacking = what_is_lacking(c.views, all.width, all.height);
  return c;
}

const char* to_string(CalibratedLens kind) {
  return kind == CalibratedLens::kPlumbBob  ? "plumb_bob"
         : kind == CalibratedLens::kFisheye ? "fisheye"
                                            : "rational";
}

}  // namespace edgevo
