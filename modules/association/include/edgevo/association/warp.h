// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Local affine warp from a host image to a target image, and host patches warped into the target.
#include <Eigen/Core>
#include <array>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Warp d p_target / d p_host (2x2) of a surface patch of constant depth, from predicted pose and depth.
Eigen::Matrix2d patch_warp(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector2d& px_host,
                           double idepth);

/// Direction of a host edge normal in the target: the unit vector along A^-T n.
Eigen::Vector2d warp_normal(const Eigen::Matrix2d& A_target_host, const Eigen::Vector2d& normal_host);

/// Largest radius of a patch, pixels: that of the largest patch_side, 11, and kRefinementRadius + 1.
constexpr int kMaxPatchRadius = 5;
/// Largest number of pixels of a patch.
constexpr int kMaxPatchPixels = (2 * kMaxPatchRadius + 1) * (2 * kMaxPatchRadius + 1);

/// Square patch, row by row, with a side of 2 radius + 1 pixels.
struct Patch {
  /// Radius, pixels, up to kMaxPatchRadius.
  int radius = 0;
  /// Values of the pixels; the first size() are valid.
  std::array<float, kMaxPatchPixels> value;
  /// Side, pixels.
  int side() const { return 2 * radius + 1; }
  /// Number of pixels.
  int size() const { return side() * side(); }
};

/// Normalises a patch to zero mean and unit standard deviation, so that gain and offset of the light cancel.
/// Returns the original standard deviation; if that is below `min_deviation` (a flat patch), returns 0 and
/// leaves the patch unchanged.
[[nodiscard]] float normalise(Patch* patch, float min_deviation);

/// Removes from the derivative of a patch what its normalisation cancels: the mean, and the component along
/// the patch itself.
void project_out_normalisation(const Patch& normalised, Patch* derivative);

/// Samples the host patch around px_host warped into the target: values at host positions px_host + A^-1 (u,
/// v); pixels of 16 bits become gray levels (deep_gray.h). False if it leaves the image.
template <class T>
bool sample_warped(const ImageView<T>& host, const Eigen::Vector2d& px_host,
                   const Eigen::Matrix2d& A_target_host, int radius, Patch* patch);

/// Samples the patch around (x, y) of an image without a warp; pixels as above. False if it leaves the image.
template <class T>
bool sample_patch(const ImageView<T>& image, double x, double y, int radius, Patch* patch);

}  // namespace edgevo
