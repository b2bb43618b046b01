#pragma once
// Local affine warp from a host image to a target image, and patches of the host as they should look in the target.
#include <Eigen/Core>
#include <array>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// d p_target / d p_host (2x2) of a surface patch of constant depth, by predicted rotation, translation and depth.
Eigen::Matrix2d patch_warp(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector2d& px_host, double idepth);

/// Where an edge normal of the host points in the target: the unit vector along A^-T n.
Eigen::Vector2d warp_normal(const Eigen::Matrix2d& A_target_host, const Eigen::Vector2d& normal_host);

/// Pixels: of the largest patch_side, 11, and of refine_radius and a pixel more.
constexpr int kMaxPatchRadius = 5;
/// 121: memory of a Patch.
constexpr int kMaxPatchPixels = (2 * kMaxPatchRadius + 1) * (2 * kMaxPatchRadius + 1);

/// Square patch, row by row, (2 radius + 1) pixels a side.
struct Patch {
  int radius = 0;  ///< pixels, up to kMaxPatchRadius
  std::array<float, kMaxPatchPixels> value;  ///< the first size() of them count
  int side() const { return 2 * radius + 1; }  ///< pixels
  int size() const { return side() * side(); }  ///< pixels
};

/// Brings a patch to zero mean and unit deviation, so that gain and offset of the light cancel. Returns its deviation; 0, and the patch
/// untouched, where that is below `min_deviation`: a flat patch says nothing.
[[nodiscard]] float normalise(Patch* patch, float min_deviation);

/// Takes out of a patch's derivative what its normalisation cancels: the mean, and the part along the patch itself.
void project_out_normalisation(const Patch& normalised, Patch* derivative);

/// The host patch around px_host as the target will see it: value at host position px_host + A^-1 (u, v). False outside the image.
template <class T>
bool sample_warped(const ImageView<T>& host, const Eigen::Vector2d& px_host, const Eigen::Matrix2d& A_target_host, int radius,
                   Patch* patch);

/// The patch around (x, y) of an image, not warped. False outside the image.
template <class T>
bool sample_patch(const ImageView<T>& image, double x, double y, int radius, Patch* patch);

}  // namespace edgevo
