// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/patch_template.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/patch_normalisation.h"
#include "edgevo/edges/sample_square.h"

namespace edgevo {
namespace {

constexpr int kWideSide = kPatchSide + 2;  // pixels: one more on each side for central differences
using Patch = std::array<float, kPatchPixels>;
constexpr float kMinDeviation = 1.0f;  // gray levels or gradient units: flatter patches are uninformative

// Values of a square, with what wide sampling writes beyond.
template <int kSide>
using Square = std::array<float, wide_square_floats(kSide)>;

// Samples a square of kSide pixels around (x, y); false if it does not lie in the image.
template <int kSide, class T>
bool sample(const ImageView<T>& image, float x, float y, Square<kSide>* out) {
  constexpr int kRadius = kSide / 2;  // pixels
  const float xf = std::floor(x), yf = std::floor(y);
  if (!(xf >= kRadius && yf >= kRadius && xf < float(image.width - kRadius - 1) &&
        yf < float(image.height - kRadius - 1)))
    return false;
  const int left = int(xf) - kRadius;
  const T* corner = image.data + (int(yf) - kRadius) * image.stride + left;
  if (image.width - left >= wide_square_columns(kSide))
    sample_square_wide<kSide>(corner, image.stride, x - xf, y - yf, out->data());
  else
    sample_square<kSide>(corner, image.stride, x - xf, y - yf, out->data());
  return true;
}

// Normalises to zero mean and unit standard deviation; returns the standard deviation, or 0 for a flat patch.
float normalise(Patch* patch) {
  const PatchMoments m = patch_moments(patch->data(), kPatchPixels);
  if (!(m.deviation >= kMinDeviation)) return 0;
  const float scale = 1.0f / m.deviation;
  for (float& v : *patch) v = (v - m.mean) * scale;
  return m.deviation;
}

}  // namespace

template <class T>
PatchTemplates cut_patches(const ImageView<T>& image, const std::vector<Eigen::Vector2f>& positions) {
  PatchTemplates patches(positions.size());
  for (size_t k = 0; k < positions.size(); ++k) {
    PatchTemplate& p = patches[k];
    const float x = positions[k].x(), y = positions[k].y();
    Square<kWideSide> wide;
    if (!sample<kWideSide>(image, x, y, &wide)) continue;
    const auto centre = [&wide](int i) {
      return &wide[(i / kPatchSide + 1) * kWideSide + i % kPatchSide + 1];
    };
    for (int i = 0; i < kPatchPixels; ++i) p.value[i] = *centre(i);
    const float deviation = normalise(&p.value);
    if (deviation == 0) continue;
    const float half = 0.5f / deviation;
    for (int i = 0; i < kPatchPixels; ++i) {
      const float* c = centre(i);
      p.gx[i] = half * (c[1] - c[-1]);
      p.gy[i] = half * (c[kWideSide] - c[-kWideSide]);
    }
    project_out_normalisation(p.value.data(), kPatchPixels, p.gx.data());
    project_out_normalisation(p.value.data(), kPatchPixels, p.gy.data());
    double xx = 0, xy = 0, yy = 0;
    for (int i = 0; i < kPatchPixels; ++i)
      xx += p.gx[i] * p.gx[i], xy += p.gx[i] * p.gy[i], yy += p.gy[i] * p.gy[i];
    p.information << xx, xy, xy, yy;
    p.information /= kPatchPixels;
    p.usable = true;
  }
  return patches;
}

// The template has zero mean and unit standard deviation, and its derivatives are orthogonal to a constant
// and to itself. So of the normalisation of the image only the division by its standard deviation remains in
// the sums, and a single loop over the pixels is enough.
template <class T>
PatchDifference compare_patch(const ImageView<T>& image, const PatchTemplate& patch, float x, float y) {
  PatchDifference d;
  Square<kPatchSide> current;
  if (!patch.usable || !sample<kPatchSide>(image, x, y, &current)) return d;
  float sum = 0, square = 0, product = 0, bx = 0, by = 0;
#pragma omp simd reduction(+ : sum, square, product, bx, by)
  for (int i = 0; i < kPatchPixels; ++i) {
    const float v = current[i];
    sum += v;
    square += v * v;
    product += v * patch.value[i];
    bx += v * patch.gx[i];
    by += v * patch.gy[i];
  }
  const float mean = sum / kPatchPixels;
  const float deviation = std::sqrt(std::max(0.0f, square / kPatchPixels - mean * mean));
  if (!(deviation >= kMinDeviation)) return d;
  const float scale = 1.0f / (deviation * kPatchPixels);
  d.usable = true;
  d.mean_square = std::max(0.0f, 2.0f - 2.0f * product * scale);
  d.gradient = Eigen::Vector2d(bx * scale, by * scale);
  return d;
}

template PatchTemplates cut_patches(const ImageView<uint8_t>&, const std::vector<Eigen::Vector2f>&);
template PatchTemplates cut_patches(const ImageView<uint16_t>&, const std::vector<Eigen::Vector2f>&);
template PatchTemplates cut_patches(const ImageView<float>&, const std::vector<Eigen::Vector2f>&);
template PatchDifference compare_patch(const ImageView<uint8_t>&, const PatchTemplate&, float, float);
template PatchDifference compare_patch(const ImageView<uint16_t>&, const PatchTemplate&, float, float);
template PatchDifference compare_patch(const ImageView<float>&, const PatchTemplate&, float, float);

}  // namespace edgevo
