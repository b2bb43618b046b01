// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/warp.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "edgevo/alignment/patch_normalisation.h"
#include "edgevo/alignment/projection.h"
#include "edgevo/core/simd.h"
#include "edgevo/edges/sample_square.h"

namespace edgevo {

Eigen::Matrix2d patch_warp(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector2d& px_host,
                           double idepth) {
  // d p' / d ray R d ray / d px at fixed inverse depth.
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
  constexpr double kNoLength = 1e-12;  // the warp collapses the normal, which then keeps its direction
  return length > kNoLength ? Eigen::Vector2d(n / length) : normal_host;
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

namespace {

// Patches are placed and interpolated in whole registers: beyond the last pixel lies its centre again.
constexpr int kLanes = 8;
constexpr int kMaxLanes = (kMaxPatchPixels + kLanes - 1) / kLanes * kLanes;
constexpr int whole_lanes(int pixels) { return (pixels + kLanes - 1) / kLanes * kLanes; }

// Positions (u, v) of the pixels of a patch relative to its centre.
struct PatchGrid {
  std::array<float, kMaxLanes> u{}, v{};
};
constexpr PatchGrid patch_grid(int radius) {
  PatchGrid grid;
  const int side = 2 * radius + 1;
  for (int i = 0; i < side * side; ++i)
    grid.u[size_t(i)] = float(i % side - radius), grid.v[size_t(i)] = float(i / side - radius);
  return grid;
}
static_assert(kMaxPatchRadius == 5);
constexpr std::array<PatchGrid, kMaxPatchRadius + 1> kGrids{patch_grid(0), patch_grid(1), patch_grid(2),
                                                            patch_grid(3), patch_grid(4), patch_grid(5)};

// Positions of the pixels of a warped patch in the host: grid point, as an offset into the image, and
// sub-pixel fraction.
struct WarpedGrid {
  std::array<int32_t, kMaxLanes> offset;
  std::array<float, kMaxLanes> fx, fy;
};

// `count`: a multiple of kLanes.
EDGEVO_WIDE_CLONES void place_grid(float cx, float cy, const Eigen::Matrix2f& B, const PatchGrid& patch,
                                   int count, int stride, WarpedGrid* __restrict grid) {
  const float b00 = B(0, 0), b01 = B(0, 1), b10 = B(1, 0), b11 = B(1, 1);
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const float du = patch.u[i], dv = patch.v[i];
    const float x = cx + b00 * du + b01 * dv, y = cy + b10 * du + b11 * dv;
    const int x0 = int(x), y0 = int(y);
    grid->offset[i] = y0 * stride + x0;
    grid->fx[i] = x - float(x0);
    grid->fy[i] = y - float(y0);
  }
}

// The four grid values around each pixel, gathered one by one and interpolated with SIMD.
template <class T>
struct Corners {
  std::array<T, kMaxLanes> top_left, top_right, bottom_left, bottom_right;
};

template <class T>
EDGEVO_WIDE_CLONES void interpolate(const Corners<T>& c, const WarpedGrid& grid, int count,
                                    float* __restrict out) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const float top = float(c.top_left[i]) + grid.fx[i] * (float(c.top_right[i]) - float(c.top_left[i]));
    const float bottom =
        float(c.bottom_left[i]) + grid.fx[i] * (float(c.bottom_right[i]) - float(c.bottom_left[i]));
    out[i] = kGrayPerStep<T> * (top + grid.fy[i] * (bottom - top));
  }
}

}  // namespace

template <class T>
bool sample_warped(const ImageView<T>& host, const Eigen::Vector2d& px_host,
                   const Eigen::Matrix2d& A_target_host, int radius, Patch* patch) {
  // Limits of area in the target over area in the host: beyond them the patch is a streak, or a few magnified
  // pixels.
  constexpr double kMinArea = 0.05, kMaxArea = 20.0;
  const double det = A_target_host.determinant();
  if (!(det > kMinArea && det < kMaxArea)) return false;
  const Eigen::Matrix2f B = A_target_host.inverse().cast<float>();
  const float reach_x = (std::abs(B(0, 0)) + std::abs(B(0, 1))) * float(radius);
  const float reach_y = (std::abs(B(1, 0)) + std::abs(B(1, 1))) * float(radius);
  const float cx = float(px_host.x()), cy = float(px_host.y());
  if (!(cx - reach_x >= 0 && cy - reach_y >= 0 && cx + reach_x < float(host.width - 1) &&
        cy + reach_y < float(host.height - 1)))
    return false;
  patch->radius = radius;
  const int count = patch->size();
  WarpedGrid grid;
  place_grid(cx, cy, B, kGrids[size_t(radius)], whole_lanes(count), int(host.stride), &grid);
  Corners<T> corners;
  for (int i = 0; i < count; ++i) {
    const T* p = host.data + grid.offset[i];
    corners.top_left[i] = p[0], corners.top_right[i] = p[1];
    p += host.stride;
    corners.bottom_left[i] = p[0], corners.bottom_right[i] = p[1];
  }
  interpolate(corners, grid, count, patch->value.data());
  return true;
}

namespace {

// A square with `columns` pixels of the image from its first column on.
template <int kSide, class T>
void sample(const T* corner, std::ptrdiff_t stride, int columns, float fx, float fy, Patch* patch) {
  static_assert(wide_square_floats(kSide) <= kMaxPatchPixels);
  if (columns >= wide_square_columns(kSide))
    sample_square_wide<kSide>(corner, stride, fx, fy, patch->value.data());
  else
    sample_square<kSide>(corner, stride, fx, fy, patch->value.data());
}

}  // namespace

template <class T>
bool sample_patch(const ImageView<T>& image, double x, double y, int radius, Patch* patch) {
  const double xf = std::floor(x), yf = std::floor(y);
  if (!(xf >= radius && yf >= radius && xf < image.width - radius - 1 && yf < image.height - radius - 1))
    return false;
  const float fx = float(x - xf), fy = float(y - yf);
  const int left = int(xf) - radius, columns = image.width - left;
  const T* corner = image.data + (int(yf) - radius) * image.stride + left;
  patch->radius = radius;
  static_assert(kMaxPatchRadius == 5);
  switch (radius) {
    case 0:
      patch->value[0] = kGrayPerStep<T> * bilinear(image, float(x), float(y));
      break;
    case 1:
      sample_square<3>(corner, image.stride, fx, fy, patch->value.data());
      break;
    case 2:
      sample<5>(corner, image.stride, columns, fx, fy, patch);
      break;
    case 3:
      sample<7>(corner, image.stride, columns, fx, fy, patch);
      break;
    case 4:
      sample<9>(corner, image.stride, columns, fx, fy, patch);
      break;
    default:
      sample<11>(corner, image.stride, columns, fx, fy, patch);
      break;
  }
  return true;
}

template bool sample_warped(const ImageView<uint8_t>&, const Eigen::Vector2d&, const Eigen::Matrix2d&, int,
                            Patch*);
template bool sample_warped(const ImageView<uint16_t>&, const Eigen::Vector2d&, const Eigen::Matrix2d&, int,
                            Patch*);
template bool sample_warped(const ImageView<float>&, const Eigen::Vector2d&, const Eigen::Matrix2d&, int,
                            Patch*);
template bool sample_patch(const ImageView<uint8_t>&, double, double, int, Patch*);
template bool sample_patch(const ImageView<uint16_t>&, double, double, int, Patch*);
template bool sample_patch(const ImageView<float>&, double, double, int, Patch*);

}  // namespace edgevo
