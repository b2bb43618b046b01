#include "edgevo/association/warp.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "edgevo/alignment/patch_normalisation.h"
#include "edgevo/alignment/projection.h"

namespace edgevo {

Eigen::Matrix2d patch_warp(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector2d& px_host, double idepth) {
  // d p' / d ray R d ray / d px, the inverse depth held.
  const Eigen::Matrix3d R = T_target_host.R();
  const Eigen::Vector3d Y = R * camera.ray(px_host) + idepth * T_target_host.translation();
  if (!(Y.z() > kMinProjectedDepth)) return Eigen::Matrix2d::Identity();
  Eigen::Matrix<double, 3, 2> d_ray;
  d_ray << 1.0 / camera.fx, 0, 0, 1.0 / camera.fy, 0, 0;
  return projection_jacobian(camera, Y) * R * d_ray;
}

Eigen::Vector2d warp_normal(const Eigen::Matrix2d& A, const Eigen::Vector2d& normal_host) {
  // A^-T n up to a positive factor: the cofactor matrix (det A > 0 for a patch seen from the same side).
  const Eigen::Vector2d n(A(1, 1) * normal_host.x() - A(1, 0) * normal_host.y(),
                          -A(0, 1) * normal_host.x() + A(0, 0) * normal_host.y());
  const double length = n.norm();
  return length > 1e-12 ? Eigen::Vector2d(n / length) : normal_host;
}

float normalise(Patch* patch, float min_deviation) {
  const PatchMoments m = patch_moments(patch->value.data(), patch->size());
  if (!(m.deviation >= min_deviation)) return 0;
  for (int i = 0; i < patch->size(); ++i) patch->value[i] = (patch->value[i] - m.mean) / m.deviation;
  return m.deviation;
}

void project_out_normalisation(const Patch& normalised, Patch* derivative) {
  project_out_normalisation(normalised.value.data(), normalised.size(), derivative->value.data());
}

template <class T>
bool sample_warped(const ImageView<T>& host, const Eigen::Vector2d& px_host, const Eigen::Matrix2d& A_target_host, int radius,
                   Patch* patch) {
  const double det = A_target_host.determinant();
  if (!(det > 0.05 && det < 20.0)) return false;
  const Eigen::Matrix2f B = A_target_host.inverse().cast<float>();
  const float reach_x = (std::abs(B(0, 0)) + std::abs(B(0, 1))) * float(radius);
  const float reach_y = (std::abs(B(1, 0)) + std::abs(B(1, 1))) * float(radius);
  const float cx = float(px_host.x()), cy = float(px_host.y());
  if (!(cx - reach_x >= 0 && cy - reach_y >= 0 && cx + reach_x < float(host.width - 1) &&
        cy + reach_y < float(host.height - 1)))
    return false;
  patch->radius = radius;
  float* to = patch->value.data();
  for (int v = -radius; v <= radius; ++v)
    for (int u = -radius; u <= radius; ++u)
      *to++ = bilinear(host, cx + B(0, 0) * float(u) + B(0, 1) * float(v), cy + B(1, 0) * float(u) + B(1, 1) * float(v));
  return true;
}

namespace {

// Bilinear values at a square of pixels that all lie (fx, fy) off the grid; `corner` is the grid point of the first. Each row is
// interpolated along itself once and serves the patch row above and below it.
template <int kSide, class T>
void sample_square(const T* corner, std::ptrdiff_t stride, float fx, float fy, float* to) {
  float rows[2][kSide];
  const auto interpolate = [fx](const T* row, float* out) {
    for (int u = 0; u < kSide; ++u) out[u] = float(row[u]) + fx * (float(row[u + 1]) - float(row[u]));
  };
  interpolate(corner, rows[0]);
  for (int v = 0; v < kSide; ++v, to += kSide) {
    const float* above = rows[v & 1];
    float* below = rows[(v + 1) & 1];
    corner += stride;
    interpolate(corner, below);
    for (int u = 0; u < kSide; ++u) to[u] = above[u] + fy * (below[u] - above[u]);
  }
}

}  // namespace

template <class T>
bool sample_patch(const ImageView<T>& image, double x, double y, int radius, Patch* patch) {
  const double xf = std::floor(x), yf = std::floor(y);
  if (!(xf >= radius && yf >= radius && xf < image.width - radius - 1 && yf < image.height - radius - 1)) return false;
  const float fx = float(x - xf), fy = float(y - yf);
  const T* corner = image.data + (int(yf) - radius) * image.stride + int(xf) - radius;
  float* to = patch->value.data();
  patch->radius = radius;
  static_assert(kMaxPatchRadius == 5);
  switch (radius) {
    case 0: to[0] = bilinear(image, float(x), float(y)); break;
    case 1: sample_square<3>(corner, image.stride, fx, fy, to); break;
    case 2: sample_square<5>(corner, image.stride, fx, fy, to); break;
    case 3: sample_square<7>(corner, image.stride, fx, fy, to); break;
    case 4: sample_square<9>(corner, image.stride, fx, fy, to); break;
    default: sample_square<11>(corner, image.stride, fx, fy, to); break;
  }
  return true;
}

template bool sample_warped(const ImageView<uint8_t>&, const Eigen::Vector2d&, const Eigen::Matrix2d&, int, Patch*);
template bool sample_warped(const ImageView<float>&, const Eigen::Vector2d&, const Eigen::Matrix2d&, int, Patch*);
template bool sample_patch(const ImageView<uint8_t>&, double, double, int, Patch*);
template bool sample_patch(const ImageView<float>&, double, double, int, Patch*);

}  // namespace edgevo
