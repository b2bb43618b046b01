#pragma once
// Illumination-robust template cost: gradient-magnitude patches, each divided by its own mean, compared by
// the mean absolute difference. Without the division exposure jumps are fatal. 0 is equal; unrelated edges
// cost 0.5 or more.
#include "edgevo/association/warp.h"

namespace edgevo {

/// The largest there is: |a - b| of patches of mean 1 where they do not overlap. Also of a patch that leaves
/// the image or says nothing.
constexpr double kWorstPatchCost = 2.0;

/// Divides by the mean; false for a patch without gradient.
[[nodiscard]] bool divide_by_mean(Patch* patch);

/// `prepared` went through divide_by_mean. Returns kWorstPatchCost where (x, y) is too close to the border or
/// flat.
double patch_cost(const Patch& prepared, const ImageView<float>& gradient_magnitude, double x, double y);

}  // namespace edgevo
