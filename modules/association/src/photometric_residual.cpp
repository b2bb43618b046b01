#include "edgevo/association/photometric_residual.h"

#include <Eigen/LU>
#include <cmath>

namespace edgevo {
namespace {

constexpr int kRadius = 2;
constexpr double kMaxShiftPx = 1.5;     // beyond it the linearisation says nothing
constexpr double kMaxMeanSquare = 1.0;  // half way to unrelated patches (2)
constexpr float kMinDeviation = 4.0f;   // Sobel units: half a gray level per pixel

float normalise(Patch* patch) {
  const int n = patch->size();
  float sum = 0, square = 0;
  for (int i = 0; i < n; ++i) sum += patch->value[i], square += patch->value[i] * patch->value[i];
  const float mean = sum / float(n);
  const float deviation = std::sqrt(std::max(0.0f, square / float(n) - mean * mean));
  if (!(deviation >= kMinDeviation)) return 0;
  for (int i = 0; i < n; ++i) patch->value[i] = (patch->value[i] - mean) / deviation;
  return deviation;
}

}  // namespace

PhotometricResidual photometric_residual(const ImageView<float>& host, const Eigen::Vector2d& px_host,
                                         const Eigen::Matrix2d& A_target_host, const ImageView<float>& target,
                                         const Eigen::Vector2d& px_target) {
  PhotometricResidual result;
  Patch wide, current;
  if (!sample_warped(host, px_host, A_target_host, kRadius + 1, &wide)) return result;
  if (!sample_patch(target, px_target.x(), px_target.y(), kRadius, &current) || normalise(&current) == 0) return result;
  const int side = 2 * kRadius + 1, wide_side = wide.side();
  Patch value, gx, gy;
  value.radius = kRadius;
  for (int v = 0; v < side; ++v)
    for (int u = 0; u < side; ++u) {
      const float* c = &wide.value[(v + 1) * wide_side + u + 1];
      value.value[v * side + u] = *c;
      gx.value[v * side + u] = 0.5f * (c[1] - c[-1]);
      gy.value[v * side + u] = 0.5f * (c[wide_side] - c[-wide_side]);
    }
  const float deviation = normalise(&value);
  if (deviation == 0) return result;
  const int n = side * side;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d g(gx.value[i] / deviation, gy.value[i] / deviation);
    const double r = double(current.value[i]) - value.value[i];  // Eq. (photometricerror)
    A += g * g.transpose() / n;
    b += g * r / n;
    result.mean_square += r * r / n;
  }
  if (!(A.determinant() > 1e-8) || result.mean_square > kMaxMeanSquare) return result;
  result.information = A;
  result.shift = -A.inverse() * b;
  result.usable = result.shift.norm() < kMaxShiftPx;
  return result;
}

}  // namespace edgevo
