// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/normal_refinement.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kStopPx = 0.02;    // the iteration stops at a shorter step: matches have 0.3 px of noise
constexpr double kMaxStepPx = 1.0;  // limit of the linearisation
constexpr float kMinGrayDeviation = 1.5f;  // gray levels: a patch below it is noise
constexpr int kMaxIterations = 12;
constexpr double kMaxMovePx = 3.0;     // a refinement that moves further is on another edge
constexpr double kMaxZnccLoss = 0.15;  // 1 - ZNCC: the patch does not fit
// Mean square of the slope, standard deviations per pixel: below it the patch is constant along the normal.
constexpr double kMinSlope = 1e-3;

// Comparison of the normalised image at a trial position with the template.
struct Comparison {
  float correlation = 0;  // sum of products, at most the number of pixels
  float gradient = 0;     // sum of slope * (image - template)
};

// The template has zero mean, and its slope is orthogonal to a constant and to the template itself. So of the
// normalisation of the image only the division by its standard deviation remains in both sums, and a single
// loop over the pixels is enough.
bool compare(const NormalTemplate& patch, const Patch& image, Comparison* out) {
  const int n = image.size();
  const float* v = image.value.data();
  const float* t = patch.value.value.data();
  const float* s = patch.slope.value.data();
  float sum = 0, square = 0, correlation = 0, gradient = 0;
#pragma omp simd reduction(+ : sum, square, correlation, gradient)
  for (int i = 0; i < n; ++i) {
    sum += v[i];
    square += v[i] * v[i];
    correlation += v[i] * t[i];
    gradient += v[i] * s[i];
  }
  const float mean = sum / float(n);
  const float deviation = std::sqrt(std::max(0.0f, square / float(n) - mean * mean));
  if (!(deviation >= kMinGrayDeviation)) return false;
  out->correlation = correlation / deviation;
  out->gradient = gradient / deviation;
  return true;
}

}  // namespace

template <class T>
bool make_normal_template(const ImageView<T>& host, const Eigen::Vector2d& px_host,
                          const Eigen::Matrix2d& A_target_host, const Eigen::Vector2d& normal_target,
                          int radius, NormalTemplate* out) {
  // One pixel more on each side for central differences.
  Patch wide;
  if (!sample_warped(host, px_host, A_target_host, radius + 1, &wide)) return false;
  const int side = 2 * radius + 1, wide_side = wide.side();
  out->value.radius = out->slope.radius = radius;
  const float nx = float(normal_target.x()), ny = float(normal_target.y());
  for (int v = 0; v < side; ++v) {
    const float* c = &wide.value[size_t((v + 1) * wide_side + 1)];
    float* __restrict value = &out->value.value[size_t(v * side)];
    float* __restrict slope = &out->slope.value[size_t(v * side)];
#pragma omp simd
    for (int u = 0; u < side; ++u) {
      value[u] = c[u];
      slope[u] = 0.5f * (nx * (c[u + 1] - c[u - 1]) + ny * (c[u + wide_side] - c[u - wide_side]));
    }
  }
  const float deviation = normalise(&out->value, kMinGrayDeviation);
  if (deviation == 0) return false;
  const int n = side * side;
  for (int i = 0; i < n; ++i) out->slope.value[i] /= deviation;
  project_out_normalisation(out->value, &out->slope);
  double square = 0;
  for (int i = 0; i < n; ++i) square += double(out->slope.value[i]) * out->slope.value[i];
  out->slope_square = square;
  return square > kMinSlope * n;
}

template <class T>
NormalRefinement refine_along_normal(const NormalTemplate& patch, const ImageView<T>& target,
                                     const Eigen::Vector2d& start, const Eigen::Vector2d& normal) {
  NormalRefinement result;
  const int n = patch.value.size();
  double move = 0;
  for (int iteration = 0; iteration <= kMaxIterations; ++iteration) {
    const Eigen::Vector2d px = start + move * normal;
    Patch current;
    Comparison c;
    if (!sample_patch(target, px.x(), px.y(), patch.value.radius, &current) || !compare(patch, current, &c))
      return result;
    const double step = -double(c.gradient) / patch.slope_square;
    result.px = px;
    result.move_px = move;
    result.zncc_loss = 1.0 - double(c.correlation) / n;
    if (std::abs(step) < kStopPx) break;
    if (iteration == kMaxIterations) return result;
    move += std::clamp(step, -kMaxStepPx, kMaxStepPx);
    if (std::abs(move) > kMaxMovePx) return result;
  }
  result.accepted = result.zncc_loss < kMaxZnccLoss;
  return result;
}

template bool make_normal_template(const ImageView<uint8_t>&, const Eigen::Vector2d&, const Eigen::Matrix2d&,
                                   const Eigen::Vector2d&, int, NormalTemplate*);
template bool make_normal_template(const ImageView<uint16_t>&, const Eigen::Vector2d&, const Eigen::Matrix2d&,
                                   const Eigen::Vector2d&, int, NormalTemplate*);
template NormalRefinement refine_along_normal(const NormalTemplate&, const ImageView<uint8_t>&,
                                              const Eigen::Vector2d&, const Eigen::Vector2d&);
template NormalRefinement refine_along_normal(const NormalTemplate&, const ImageView<uint16_t>&,
                                              const Eigen::Vector2d&, const Eigen::Vector2d&);

}  // namespace edgevo
