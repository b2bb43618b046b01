#include "edgevo/association/photometric_residual.h"

#include <Eigen/LU>
#include <cmath>

namespace edgevo {
namespace {

constexpr int kRadius = 2;                  // pixels: the paper's patch of 5x5
constexpr double kMaxShiftPx = 1.5;         // beyond it the linearisation says nothing
constexpr double kMaxMeanSquare = 1.0;      // half way to unrelated patches (2)
constexpr float kMinSobelDeviation = 4.0f;  // Sobel units: half a gray level per pixel
// Determinant, px^-4: a patch that is the same along some direction fixes no shift.
constexpr double kLeastInformation = 1e-8;

}  // namespace

PhotometricResidual photometric_residual(const ImageView<float>& host, const Eigen::Vector2d& px_host,
                                         const Eigen::Matrix2d& A_target_host, const ImageView<float>& target,
                                         const Eigen::Vector2d& px_target) {
  PhotometricResidual result;
  Patch wide, current;
  if (!sample_warped(host, px_host, A_target_host, kRadius + 1, &wide)) return result;
  if (!sample_patch(target, px_target.x(), px_target.y(), kRadius, &current) ||
      normalise(&current, kMinSobelDeviation) == 0)
    return result;
  const int side = 2 * kRadius + 1, wide_side = wide.side();
  Patch value, gx, gy;
  value.radius = gx.radius = gy.radius = kRadius;
  for (int v = 0; v < side; ++v)
    for (int u = 0; u < side; ++u) {
      const float* c = &wide.value[(v + 1) * wide_side + u + 1];
      value.value[v * side + u] = *c;
      gx.value[v * side + u] = 0.5f * (c[1] - c[-1]);
      gy.value[v * side + u] = 0.5f * (c[wide_side] - c[-wide_side]);
    }
  const float deviation = normalise(&value, kMinSobelDeviation);
  if (deviation == 0) return result;
  const int n = side * side;
  for (int i = 0; i < n; ++i) gx.value[i] /= deviation, gy.value[i] /= deviation;
  project_out_normalisation(value, &gx);
  project_out_normalisation(value, &gy);
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d g(gx.value[i], gy.value[i]);
    const double r = double(current.value[i]) - value.value[i];  // Eq. (photometricerror)
    A += g * g.transpose() / n;
    b += g * r / n;
    result.mean_square += r * r / n;
  }
  if (!(A.determinant() > kLeastInformation) || result.mean_square > kMaxMeanSquare) return result;
  result.information = A;
  result.shift = -A.inverse() * b;
  result.usable = result.shift.norm() < kMaxShiftPx;
  return result;
}

}  // namespace edgevo
