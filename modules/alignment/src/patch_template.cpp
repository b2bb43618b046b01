#include "edgevo/alignment/patch_template.h"

#include <cmath>

#include "edgevo/alignment/patch_normalisation.h"

namespace edgevo {
namespace {

using Patch = std::array<float, kPatchPixels>;
constexpr float kMinDeviation = 1.0f;  // gray levels (or gradient units): flatter patches say nothing

// Samples the patch at (x, y); all its pixels share the fractional part, so that the four weights are constants.
template <class T>
bool sample(const ImageView<T>& image, float x, float y, Patch* out) {
  const float xf = std::floor(x), yf = std::floor(y);
  if (!(xf >= kPatchRadius && yf >= kPatchRadius && xf < float(image.width - kPatchRadius - 1) &&
        yf < float(image.height - kPatchRadius - 1)))
    return false;
  const float fx = x - xf, fy = y - yf;
  const float w00 = (1 - fx) * (1 - fy), w01 = fx * (1 - fy), w10 = (1 - fx) * fy, w11 = fx * fy;
  const T* row = image.data + (int(yf) - kPatchRadius) * image.stride + int(xf) - kPatchRadius;
  float* to = out->data();
  for (int v = 0; v < kPatchSide; ++v, row += image.stride, to += kPatchSide) {
    const T* below = row + image.stride;
    for (int u = 0; u < kPatchSide; ++u)
      to[u] = w00 * float(row[u]) + w01 * float(row[u + 1]) + w10 * float(below[u]) + w11 * float(below[u + 1]);
  }
  return true;
}

// To zero mean and unit deviation; returns the deviation, or 0 for a flat patch.
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
    Patch left, right, up, down;
    if (!sample(image, x, y, &p.value) || !sample(image, x - 1, y, &left) || !sample(image, x + 1, y, &right) ||
        !sample(image, x, y - 1, &up) || !sample(image, x, y + 1, &down))
      continue;
    const float deviation = normalise(&p.value);
    if (deviation == 0) continue;
    const float half = 0.5f / deviation;
    for (int i = 0; i < kPatchPixels; ++i) {
      p.gx[i] = half * (right[i] - left[i]);
      p.gy[i] = half * (down[i] - up[i]);
    }
    project_out_normalisation(p.value.data(), kPatchPixels, p.gx.data());
    project_out_normalisation(p.value.data(), kPatchPixels, p.gy.data());
    double xx = 0, xy = 0, yy = 0;
    for (int i = 0; i < kPatchPixels; ++i) xx += p.gx[i] * p.gx[i], xy += p.gx[i] * p.gy[i], yy += p.gy[i] * p.gy[i];
    p.information << xx, xy, xy, yy;
    p.information /= kPatchPixels;
    p.usable = true;
  }
  return patches;
}

template <class T>
PatchDifference compare_patch(const ImageView<T>& image, const PatchTemplate& patch, float x, float y) {
  PatchDifference d;
  Patch current;
  if (!patch.usable || !sample(image, x, y, &current) || normalise(&current) == 0) return d;
  float square = 0, bx = 0, by = 0;
  for (int i = 0; i < kPatchPixels; ++i) {
    const float r = current[i] - patch.value[i];
    square += r * r;
    bx += patch.gx[i] * r;
    by += patch.gy[i] * r;
  }
  d.usable = true;
  d.mean_square = square / kPatchPixels;
  d.gradient = Eigen::Vector2d(bx, by) / kPatchPixels;
  return d;
}

template PatchTemplates cut_patches(const ImageView<uint8_t>&, const std::vector<Eigen::Vector2f>&);
template PatchTemplates cut_patches(const ImageView<float>&, const std::vector<Eigen::Vector2f>&);
template PatchDifference compare_patch(const ImageView<uint8_t>&, const PatchTemplate&, float, float);
template PatchDifference compare_patch(const ImageView<float>&, const PatchTemplate&, float, float);

}  // namespace edgevo
