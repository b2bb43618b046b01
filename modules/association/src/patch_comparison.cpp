// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/patch_comparison.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

// Mean difference of gray levels that costs 1, about that of unrelated edges.
constexpr float kGrayLevelsOfOne = 80.0f;

float mean_difference(const Patch& a, const Patch& b) {
  float sum = 0;
  const int n = a.size();
  for (int i = 0; i < n; ++i) sum += std::abs(a.value[i] - b.value[i]);
  return sum / float(n);
}

class GradientComparison final : public PatchComparison {
 public:
  bool cut(const PyramidLevel& host, const Eigen::Vector2d& px_host, const Eigen::Matrix2d& A, int radius,
           Patch* patch) const override {
    return sample_warped(host.gradient_magnitude.view(), px_host, A, radius, patch) && divide_by_mean(patch);
  }
  double cost(const Patch& patch, const PyramidLevel& target, double x, double y) const override {
    return patch_cost(patch, target.gradient_magnitude.view(), x, y);
  }
};

bool cut_gray(const PyramidLevel& host, const Eigen::Vector2d& px_host, const Eigen::Matrix2d& A, int radius,
              Patch* patch) {
  return host.with_gray([&](const auto& gray) { return sample_warped(gray, px_host, A, radius, patch); });
}

bool see_gray(const PyramidLevel& target, double x, double y, int radius, Patch* patch) {
  return target.with_gray([&](const auto& gray) { return sample_patch(gray, x, y, radius, patch); });
}

class IntensityComparison final : public PatchComparison {
 public:
  bool cut(const PyramidLevel& host, const Eigen::Vector2d& px_host, const Eigen::Matrix2d& A, int radius,
           Patch* patch) const override {
    return cut_gray(host, px_host, A, radius, patch);
  }
  double cost(const Patch& patch, const PyramidLevel& target, double x, double y) const override {
    Patch seen;
    if (!see_gray(target, x, y, patch.radius, &seen)) return kWorstPatchCost;
    return std::min(double(mean_difference(patch, seen) / kGrayLevelsOfOne), kWorstPatchCost);
  }
};

// A census patch contains +1 where a pixel is brighter than the centre, else -1; the centre itself is always
// -1 and does not count.
void turn_into_census(Patch* patch) {
  const int n = patch->size();
  const float centre = patch->value[n / 2];
  for (int i = 0; i < n; ++i) patch->value[i] = patch->value[i] > centre ? 1.0f : -1.0f;
}

class CensusComparison final : public PatchComparison {
 public:
  bool cut(const PyramidLevel& host, const Eigen::Vector2d& px_host, const Eigen::Matrix2d& A, int radius,
           Patch* patch) const override {
    if (!cut_gray(host, px_host, A, radius, patch)) return false;
    turn_into_census(patch);
    return true;
  }
  double cost(const Patch& patch, const PyramidLevel& target, double x, double y) const override {
    Patch seen;
    if (!see_gray(target, x, y, patch.radius, &seen)) return kWorstPatchCost;
    turn_into_census(&seen);
    const int n = patch.size();
    return double(mean_difference(patch, seen)) * n / (n - 1);  // disagreeing signs differ by two
  }
};

}  // namespace

const PatchComparison& gradient_comparison() {
  static const GradientComparison comparison;
  return comparison;
}
const PatchComparison& intensity_comparison() {
  static const IntensityComparison comparison;
  return comparison;
}
const PatchComparison& census_comparison() {
  static const CensusComparison comparison;
  return comparison;
}

}  // namespace edgevo
