// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small patches around points of a reference image, each with zero mean and unit standard deviation, so that
// gain and offset of the light cancel. They are compared with patches of another image at shifted positions;
// between two frames the warp of five pixels is negligible.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "edgevo/edges/plane.h"

namespace edgevo {

/// Radius of a patch, pixels: 25 values are distinctive, and few enough to need no warp between two frames.
constexpr int kPatchRadius = 2;
/// Side of a patch, pixels.
constexpr int kPatchSide = 2 * kPatchRadius + 1;
/// Pixels of a patch.
constexpr int kPatchPixels = kPatchSide * kPatchSide;
/// Mean square of the difference between two uncorrelated patches of unit standard deviation.
constexpr double kUnrelatedMeanSquare = 2.0;

/// Huber width on the RMS of a patch difference, in standard deviations of the patch.
constexpr double kPatchHuber = 0.5;

/// Normalised patch of the reference image, with its derivatives.
struct PatchTemplate {
  /// Whether the patch lies inside the image and is not flat.
  bool usable = false;
  /// Normalised values, row by row: zero mean, unit standard deviation.
  std::array<float, kPatchPixels> value;
  /// Derivative of `value` by a shift in x, without the component that the normalisation cancels.
  std::array<float, kPatchPixels> gx;
  /// Derivative of `value` by a shift in y, without the component that the normalisation cancels.
  std::array<float, kPatchPixels> gy;
  /// Mean over the patch of (gx, gy)(gx, gy)^T.
  Eigen::Matrix2d information;
};
/// Patches of the points of a cloud, in its order.
using PatchTemplates = std::vector<PatchTemplate>;

/// Patches centred at `positions` (pixels of this image), of gray levels (also of 16 bits, deep_gray.h) or of
/// gradients.
template <class T>
PatchTemplates cut_patches(const ImageView<T>& image, const std::vector<Eigen::Vector2f>& positions);

/// Difference between a patch and the image at one position.
struct PatchDifference {
  /// Whether the patch lies inside the image and is not flat.
  bool usable = false;
  /// Mean square of the normalised difference: 0 for equal patches, kUnrelatedMeanSquare for unrelated ones.
  float mean_square = 0;
  /// Derivative of mean_square / 2 by the shift.
  Eigen::Vector2d gradient;
};

/// Difference between `patch` and the image at (x, y), pixels.
template <class T>
PatchDifference compare_patch(const ImageView<T>& image, const PatchTemplate& patch, float x, float y);

}  // namespace edgevo
