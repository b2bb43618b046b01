// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Illumination-robust template cost: gradient-magnitude patches, each divided by its own mean, compared by
// the mean absolute difference. Without the division, exposure jumps are fatal. Equal patches cost 0,
// unrelated edges 0.5 or more.
#include "edgevo/association/warp.h"

namespace edgevo {

/// Largest cost: |a - b| of patches of mean 1 that do not overlap. Also the cost of a patch that leaves the
/// image or is flat.
constexpr double kWorstPatchCost = 2.0;

/// Divides a patch by its mean; false for a patch without gradient.
[[nodiscard]] bool divide_by_mean(Patch* patch);

/// Cost of a patch, prepared by divide_by_mean(), against the image around (x, y); kWorstPatchCost if that is
/// too close to the border or flat.
double patch_cost(const Patch& prepared, const ImageView<float>& gradient_magnitude, double x, double y);

}  // namespace edgevo
