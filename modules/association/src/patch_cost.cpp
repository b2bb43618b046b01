// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/patch_cost.h"

#include <cmath>

namespace edgevo {
namespace {

// Sobel units, an eighth of a gray level per pixel: a patch with a lower mean is noise.
constexpr float kFlat = 1.0f;

}  // namespace

bool divide_by_mean(Patch* patch) {
  float sum = 0;
  const int n = patch->size();
#pragma omp simd reduction(+ : sum)
  for (int i = 0; i < n; ++i) sum += patch->value[i];
  const float mean = sum / float(n);
  if (!(mean > kFlat)) return false;
  const float scale = 1.0f / mean;
  for (int i = 0; i < n; ++i) patch->value[i] *= scale;
  return true;
}

double patch_cost(const Patch& prepared, const ImageView<float>& gradient_magnitude, double x, double y) {
  Patch target;
  if (!sample_patch(gradient_magnitude, x, y, prepared.radius, &target) || !divide_by_mean(&target))
    return kWorstPatchCost;
  float sum = 0;
  const int n = prepared.size();
#pragma omp simd reduction(+ : sum)
  for (int i = 0; i < n; ++i) sum += std::abs(target.value[i] - prepared.value[i]);
  return double(sum) / n;
}

}  // namespace edgevo
