// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Patches of zero mean and unit standard deviation, so that gain and offset of the light cancel. A patch is
// `count` values, row by row; a constant count lets the compiler unroll the loops.
#include <algorithm>
#include <cmath>

namespace edgevo {

/// Mean and standard deviation of the values of a patch.
struct PatchMoments {
  /// Mean and standard deviation, in the unit of the patch.
  float mean = 0, deviation = 0;
};

/// Moments of the `count` > 0 values at `value`.
inline PatchMoments patch_moments(const float* value, int count) {
  float sum = 0, square = 0;
#pragma omp simd reduction(+ : sum, square)
  for (int i = 0; i < count; ++i) sum += value[i], square += value[i] * value[i];
  const float mean = sum / float(count);
  return {mean, std::sqrt(std::max(0.0f, square / float(count) - mean * mean))};
}

/// Removes from the derivative of a patch what its normalisation cancels: the mean, and the component along
/// the normalised patch itself.
inline void project_out_normalisation(const float* normalised, int count, float* derivative) {
  float mean = 0, along = 0;
#pragma omp simd reduction(+ : mean, along)
  for (int i = 0; i < count; ++i) mean += derivative[i], along += derivative[i] * normalised[i];
  mean /= float(count);
  along /= float(count);
  for (int i = 0; i < count; ++i) derivative[i] -= mean + along * normalised[i];
}

}  // namespace edgevo
