// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/fold_residual.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/radial.h"
#include "edgevo/core/rectification.h"

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

// A lens by its file, and what that has wrong.
struct Lens {
  const Camera& camera;
  ImageCorrection residual;
};

// True rays, normalised, of a grid of pixels of the distorted image; pixels without a ray are skipped.
Rays image_rays(const Lens& lens, const std::string& where) {
  const Camera& camera = lens.camera;
  const double step = std::max(1.0, std::min(camera.width, camera.height) / kLines);
  Rays rays;
  size_t pixels = 0;
  for (const double v : positions(camera.height - 1, step))
    for (const double u : positions(camera.width - 1, step)) {
      ++pixels;
      const std::optional<Eigen::Vector3d> ray = camera.unproject({u, v});
      if (ray) rays.push_back(remove_lens(lens.residual, ray->hnormalized()));
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

Eigen::Vector2d pixel(const Lens& lens, const Eigen::Vector2d& x) {
  return Rectification(lens.camera).raw_pixel(add_lens(lens.residual, x));
}

// Distance between the two models at each ray, pixels.
Eigen::ArrayXd differences(const Lens& a, const Lens& b, const Rays& rays) {
  Eigen::ArrayXd d(rays.size());
  for (size_t i = 0; i < rays.size(); ++i)
    d[Eigen::Index(i)] = (pixel(a, rays[i]) - pixel(b, rays[i])).norm();
  return d;
}

// Correction to the coefficients of `start`: the smallest one if a narrow lens leaves some of them
// undetermined.
Eigen::Matrix<double, 5, 1> fit_change(const Lens& lens, const Lens& start, const Rays& rays) {
  Eigen::Matrix<double, Eigen::Dynamic, 5> A(2 * rays.size(), 5);
  Eigen::VectorXd b(2 * rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    Row row_u, row_v;
    plumb_bob_rows(start.camera.pinhole(), rays[i], &row_u, &row_v);
    A.row(2 * Eigen::Index(i)) = row_u;
    A.row(2 * Eigen::Index(i) + 1) = row_v;
    b.segment<2>(2 * Eigen::Index(i)) = pixel(lens, rays[i]) - pixel(start, rays[i]);
  }
  return A.completeOrthogonalDecomposition().solve(b);
}

}  // namespace

FoldedCamera fold_residual(const Camera& camera, const ImageCorrection& residual, const std::string& where) {
  FoldedCamera folded;
  folded.camera = camera;
  if (residual.keeps_lens()) return folded;
  const Lens lens{camera, residual}, by_file{camera, {}};
  const Rays rays = image_rays(lens, where);
  Pinhole longer = camera.pinhole();
  longer.fx *= 1 + residual.focal, longer.fy *= 1 + residual.focal;
  folded.camera.set_pinhole(longer);
  Distortion d = camera.distortion();
  if (d.is_zero()) {
    d.k1 = residual.k1;
  } else {
    const Eigen::Matrix<double, 5, 1> change = fit_change(lens, {folded.camera, {}}, rays);
    d = {d.k1 + change[0], d.k2 + change[1], d.p1 + change[2], d.p2 + change[3], d.k3 + change[4]};
  }
  folded.camera.set_distortion(d);
  const Eigen::ArrayXd errors = differences(lens, {folded.camera, {}}, rays);
  folded.rms_error_px = std::sqrt(errors.square().mean());
  folded.max_error_px = errors.maxCoeff();
  folded.max_shift_px = differences(lens, by_file, rays).maxCoeff();
  return folded;
}

}  // namespace edgevo
