#pragma once
// Small patches around points of a reference image, each with zero mean and unit deviation, so that gain and
// offset of the light cancel. Compared with a patch of another image that is merely shifted: between two
// frames the warp of five pixels is small.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "edgevo/edges/plane.h"

namespace edgevo {

/// Pixels: 25 values tell a patch from others, and between two frames so few need no warp.
constexpr int kPatchRadius = 2;
constexpr int kPatchSide = 2 * kPatchRadius + 1;       ///< pixels
constexpr int kPatchPixels = kPatchSide * kPatchSide;  ///< 25
/// Of the difference of two patches of unit deviation that have nothing in common.
constexpr double kUnrelatedMeanSquare = 2.0;

/// Huber width on the rms of a patch difference, in deviations of the patch.
constexpr double kPatchHuber = 0.5;

/// A patch of the reference image, ready to be compared.
struct PatchTemplate {
  bool usable = false;                    ///< inside the image and not flat
  std::array<float, kPatchPixels> value;  ///< zero mean, unit deviation
  std::array<float, kPatchPixels> gx;  ///< d value / d shift in x, with the normalisation's share taken out
  std::array<float, kPatchPixels> gy;  ///< the same in y
  Eigen::Matrix2d information;  ///< sum over the patch of (gx, gy)(gx, gy)^T, divided by the number of pixels
};
using PatchTemplates = std::vector<PatchTemplate>;  ///< one for each point of a cloud, in its order

/// Patches centred at `positions` (pixels of this image).
template <class T>
PatchTemplates cut_patches(const ImageView<T>& image, const std::vector<Eigen::Vector2f>& positions);

/// How a patch differs from the image at a place.
struct PatchDifference {
  bool usable = false;       ///< inside the image and not flat
  float mean_square = 0;     ///< of the normalised difference; 0 equal, kUnrelatedMeanSquare unrelated
  Eigen::Vector2d gradient;  ///< d (mean_square / 2) / d shift
};

/// Difference of `patch` to the image at (x, y).
template <class T>
PatchDifference compare_patch(const ImageView<T>& image, const PatchTemplate& patch, float x, float y);

}  // namespace edgevo
