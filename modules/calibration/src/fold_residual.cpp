// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/fold_residual.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

// Over the shorter side of the image: many more than the lens model has inflections.
constexpr double kLines = 50;

using Row = Eigen::Matrix<double, 1, 5>;
using Rays = std::vector<Eigen::Vector2d>;

// Positions 0 .. last with both ends, about `step` apart.
std::vector<double> positions(int last, double step) {
  const int count = std::max(1, int(last / step));
  std::vector<double> all;
  for (int i = 0; i <= count; ++i) all.push_back(double(last) * i / count);
  return all;
}

// True rays of a grid of pixels of the distorted image; pixels without a ray are skipped.
Rays image_rays(const Camera& camera, const std::string& where) {
  const Pinhole& p = camera.pinhole;
  const double step = std::max(1.0, std::min(p.width, p.height) / kLines);
  Rays rays;
  size_t pixels = 0;
  for (const double v : positions(p.height - 1, step))
    for (const double u : positions(p.width - 1, step)) {
      ++pixels;
      Eigen::Vector2d x;
      if (camera.undistort(p.ray({u, v}).head<2>(), &x)) rays.push_back(x);
    }
  if (2 * rays.size() < pixels)
    throw InputError(where, "the lens model cannot be inverted over most of the image",
                     "check its distortion coefficients");
  return rays;
}

// d x_d / d (k1, k2, p1, p2, k3), in pixels.
void plumb_bob_rows(const Pinhole& c, const Eigen::Vector2d& x, Row* row_u, Row* row_v) {
  const double r2 = x.squaredNorm(), xy = 2.0 * x.x() * x.y();
  *row_u << x.x() * r2, x.x() * r2 * r2, xy, r2 + 2.0 * x.x() * x.x(), x.x() * r2 * r2 * r2;
  *row_v << x.y() * r2, x.y() * r2 * r2, r2 + 2.0 * x.y() * x.y(), xy, x.y() * r2 * r2 * r2;
  *row_u *= c.fx, *row_v *= c.fy;
}

Eigen::Vector2d pixel_difference(const Camera& a, const Camera& b, const Eigen::Vector2d& x) {
  const Eigen::Vector2d d = a.distort(x) - b.distort(x);
  return {a.pinhole.fx * d.x(), a.pinhole.fy * d.y()};
}

// Distance between the two models at each ray, pixels.
Eigen::ArrayXd differences(const Camera& a, const Camera& b, const Rays& rays) {
  Eigen::ArrayXd d(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) d[Eigen::Index(i)] = pixel_difference(a, b, rays[i]).norm();
  return d;
}

// Correction to the file's coefficients: the smallest one if a narrow lens leaves some of them undetermined.
Eigen::Matrix<double, 5, 1> fit_change(const Camera& camera, const Camera& by_file, const Rays& rays) {
  Eigen::Matrix<double, Eigen::Dynamic, 5> A(2 * rays.size(), 5);
  Eigen::VectorXd b(2 * rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    Row row_u, row_v;
    plumb_bob_rows(camera.pinhole, rays[i], &row_u, &row_v);
    A.row(2 * Eigen::Index(i)) = row_u;
    A.row(2 * Eigen::Index(i) + 1) = row_v;
    b.segment<2>(2 * Eigen::Index(i)) = pixel_difference(camera, by_file, rays[i]);
  }
  return A.completeOrthogonalDecomposition().solve(b);
}

}  // namespace

FoldedCamera fold_residual(const Camera& camera, const std::string& where) {
  FoldedCamera folded;
  folded.camera = camera;
  folded.camera.residual_k1 = 0;
  if (camera.residual_k1 == 0) return folded;
  const Camera by_file = folded.camera;
  const Rays rays = image_rays(camera, where);
  Distortion& d = folded.camera.distortion;
  if (by_file.distortion.is_zero()) {
    d.k1 = camera.residual_k1;
  } else {
    const Eigen::Matrix<double, 5, 1> change = fit_change(camera, by_file, rays);
    d = {d.k1 + change[0], d.k2 + change[1], d.p1 + change[2], d.p2 + change[3], d.k3 + change[4]};
  }
  const Eigen::ArrayXd errors = differences(camera, folded.camera, rays);
  folded.rms_error_px = std::sqrt(errors.square().mean());
  folded.max_error_px = errors.maxCoeff();
  folded.max_shift_px = differences(camera, by_file, rays).maxCoeff();
  return folded;
}

}  // namespace edgevo
