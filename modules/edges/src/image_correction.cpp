// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/image_correction.h"

#include <algorithm>

#include "edgevo/core/radial.h"

namespace edgevo {
namespace {

// Each step reduces the error to about the share of its height that the image moves during the read-out.
constexpr int kMaxSteps = 12;
// Normalised coordinates: the iteration has converged, with a margin to the documented 1e-12.
constexpr double kErrorSquare = 1e-26;
// Step of numeric differences, normalised coordinates: a hundredth of a pixel, much less than a cell of the
// motion.
constexpr double kDifference = 1e-5;
// Of rows_left: at half of it the motion is too fast to be corrected.
constexpr double kMinRows = 0.5;

// Rows by which the raw image moves while the normalised image point x moves by `shift`.
double row_shift(const Camera& camera, const Eigen::Vector2d& x, const Eigen::Vector2d& shift) {
  // These distort rows by some per cent; the others show up to four times fewer than a pinhole would.
  if (camera.plumb_bob()) return shift.y() * camera.pinhole().fy;
  const Eigen::Vector3d ray(x.x(), x.y(), 1);
  return camera.project(ray) ? camera.jacobian(ray).row(1).head<2>().dot(shift) : 0;
}

// An image point that moves down with the read-out is met at a later row than the one at which it started:
// row' = row + rate row' (share of the height), hence row' = row / (1 - rate). Returns 1 - rate.
double rows_left(const Camera& camera, double row_time_s, const Eigen::Vector2d& x,
                 const Eigen::Vector2d& velocity) {
  if (camera.height < 2) return 1;
  return std::max(kMinRows, 1 - row_shift(camera, x, row_time_s * velocity) / (camera.height - 1));
}

}  // namespace

double shutter_row(const Camera& camera, const Eigen::Vector2d& x) {
  const std::optional<Eigen::Vector2d> px = camera.project({x.x(), x.y(), 1});
  return px && camera.height > 1 ? px->y() / (camera.height - 1) - 0.5 : 0;
}

Eigen::Vector2d add_rolling(const Rectification& r, double row_time_s, const ImageMotion& motion,
                            const Eigen::Vector2d& x) {
  if (row_time_s == 0 || !motion.is_known()) return x;
  const Eigen::Vector2d velocity = motion.at(r.target(), x);
  const double t = row_time_s * shutter_row(r.camera(), x) / rows_left(r.camera(), row_time_s, x, velocity);
  const Eigen::Vector2d moved = x + t * velocity;
  return motion.turning.isZero(0) ? moved : moved + 0.5 * t * t * motion.acceleration(r.target(), x);
}

Eigen::Vector2d rolling_rate(const Rectification& r, double row_time_s, const ImageMotion& motion,
                             const Eigen::Vector2d& x) {
  if (!motion.is_known()) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d velocity = motion.at(r.target(), x);
  const double left = rows_left(r.camera(), row_time_s, x, velocity);
  const double row = shutter_row(r.camera(), x) / (left * left), t = row_time_s * row * left;
  const Eigen::Vector2d rate = row * velocity;
  return motion.turning.isZero(0) ? rate : rate + t * row * motion.acceleration(r.target(), x);
}

Eigen::Vector2d to_file(const Rectification& r, const ImageCorrection& correction, const ImageMotion& motion,
                        const Eigen::Vector2d& x) {
  return add_lens(correction, add_rolling(r, row_time(correction), motion, x));
}

Eigen::Vector2d from_file(const Rectification& r, const ImageCorrection& correction,
                          const ImageMotion& motion, const Eigen::Vector2d& x_file) {
  const Eigen::Vector2d rolling = remove_lens(correction, x_file);
  if (correction.readout_s == 0 || !motion.is_known()) return rolling;
  Eigen::Vector2d x = rolling;
  double at_first = -1, at_last = 0;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Eigen::Vector2d error = add_rolling(r, row_time(correction), motion, x) - rolling;
    x -= error;
    at_last = error.squaredNorm();
    if (at_first < 0) at_first = at_last;
    if (at_last < kErrorSquare) break;
  }
  return at_last <= at_first ? x : rolling;  // rolling: the rows overtake one another, so x is not unique
}

Eigen::Matrix2d file_jacobian(const Rectification& r, const ImageCorrection& correction,
                              const ImageMotion& motion, const Eigen::Vector2d& x) {
  const Eigen::Matrix2d lens =
      (1 + correction.focal) *
      radial_jacobian(correction.k1, add_rolling(r, row_time(correction), motion, x));
  if (correction.readout_s == 0 || !motion.is_known()) return lens;
  Eigen::Matrix2d rolling;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = kDifference * Eigen::Vector2d::Unit(axis);
    rolling.col(axis) = (add_rolling(r, row_time(correction), motion, x + step) -
                         add_rolling(r, row_time(correction), motion, x - step)) /
                        (2 * kDifference);
  }
  return lens * rolling;
}

}  // namespace edgevo
