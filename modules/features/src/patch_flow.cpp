// SPDX-License-Identifier: BSD-3-Clause
#include "patch_flow.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "edgevo/core/simd.h"
#include "edgevo/edges/opencv_view.h"
#include "edgevo/edges/sample_square.h"

// How vectors are passed depends on the target; these functions are only called within this file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edgevo {
namespace {

constexpr int kSide = 9, kPixels = kSide * kSide;
constexpr int kFramed = kSide + 2;  // with a pixel around for the gradient
constexpr int kLevels = 4, kIterations = 8;
constexpr float kMinStepPx = 0.03f;
constexpr float kTurnsBackPx = 0.01f;   // two steps that cancel
constexpr float kMinEigenvalue = 0.2f;  // of the mean squared gradient, (gray level/px)^2
// Largest mean difference of gray values of a patch that was followed.
constexpr float kMaxDifference = 25;
// Standard deviation of the gray values that images are brought to, and the least that is taken for contrast.
constexpr double kUsualContrast = 60, kMinContrast = 4, kUsualMean = 128;

constexpr int kAtOnce = 8, kBlocks = (kPixels + kAtOnce - 1) / kAtOnce;
using Floats8 = float __attribute__((vector_size(4 * kAtOnce)));

// The pixels of a patch by rows; zeros fill the last block.
using PatchValues = float[kBlocks * kAtOnce];

struct Template {
  PatchValues gray = {}, across = {}, down = {};  // value, and gradient per pixel
  Eigen::Matrix2f A;                              // sum of the gradient's products
};

struct Mismatch {
  float across = 0, down = 0;  // sum of the difference times the gradient
  float difference = 0;        // sum of its absolute value
};

inline Floats8 block(const float* values, int i) {
  Floats8 b;
  std::memcpy(&b, values + i * kAtOnce, sizeof b);
  return b;
}

inline float sum(const Floats8& v) {
  return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
}

// Scharr's gradient of values with a pixel around, per pixel.
EDGEVO_WIDE_CLONES void take_gradient(const float* framed, float* gray, float* across, float* down) {
  constexpr float kMiddle = 10.f / 32, kOuter = 3.f / 32;
  for (int y = 0; y < kSide; ++y) {
    const float *a = framed + y * kFramed, *b = a + kFramed, *c = b + kFramed;
    for (int x = 0; x < kSide; ++x) {
      const int i = y * kSide + x;
      gray[i] = b[x + 1];
      across[i] = kMiddle * (b[x + 2] - b[x]) + kOuter * ((a[x + 2] - a[x]) + (c[x + 2] - c[x]));
      down[i] = kMiddle * (c[x + 1] - a[x + 1]) + kOuter * ((c[x] - a[x]) + (c[x + 2] - a[x + 2]));
    }
  }
}

EDGEVO_WIDE_CLONES void sum_gradient(const float* across, const float* down, float* sums) {
  Floats8 xx = {}, xy = {}, yy = {};
  for (int i = 0; i < kBlocks; ++i) {
    const Floats8 x = block(across, i), y = block(down, i);
    xx += x * x, xy += x * y, yy += y * y;
  }
  sums[0] = sum(xx), sums[1] = sum(xy), sums[2] = sum(yy);
}

// `shown`: values of an image whose usual ones are gain shown + offset.
EDGEVO_WIDE_CLONES void compare(const Template& t, const float* shown, float gain, float offset,
                                Mismatch* mismatch) {
  Floats8 across = {}, down = {};
  for (int i = 0; i < kBlocks; ++i) {
    const Floats8 difference = gain * block(shown, i) + offset - block(t.gray, i);
    across += difference * block(t.across, i);
    down += difference * block(t.down, i);
  }
  mismatch->across = sum(across), mismatch->down = sum(down);
}

float mean_difference(const Template& t, const float* shown, float gain, float offset) {
  float total = 0;
  for (int i = 0; i < kPixels; ++i) total += std::abs(gain * shown[i] + offset - t.gray[i]);
  return total / kPixels;
}

// The square around `at`, by rows; beyond the border the nearest pixel counts. Returns false if the square
// lies wholly beyond.
template <int kWidth>
bool sample(const ImageView<uint8_t>& image, const Eigen::Vector2f& at, float* to) {
  constexpr int kRead = kWidth + 1;
  const float left = at.x() - kWidth / 2, top = at.y() - kWidth / 2;
  if (!(left > -kWidth && top > -kWidth && left < float(image.width) && top < float(image.height)))
    return false;
  const int x = int(std::floor(left)), y = int(std::floor(top));
  const float fx = left - float(x), fy = top - float(y);
  if (x >= 0 && y >= 0 && x + kRead <= image.width && y + kRead <= image.height) {
    sample_square_wide<kWidth>(image.data + std::ptrdiff_t(y) * image.stride + x, image.stride, fx, fy, to);
    return true;
  }
  uint8_t pixels[kRead * kRead];
  for (int v = 0; v < kRead; ++v) {
    const uint8_t* row = image.data + std::ptrdiff_t(std::clamp(y + v, 0, image.height - 1)) * image.stride;
    for (int u = 0; u < kRead; ++u) pixels[v * kRead + u] = row[std::clamp(x + u, 0, image.width - 1)];
  }
  sample_square_wide<kWidth>(pixels, kRead, fx, fy, to);
  return true;
}

// Whether the patch shows a corner.
bool take_template(const FlowImage& image, int level, const Eigen::Vector2f& at, Template* t) {
  float framed[kFramed * kFramed];
  if (!sample<kFramed>(image.levels()[size_t(level)], at, framed)) return false;
  for (float& value : framed) value = image.gain() * value + image.offset();
  take_gradient(framed, t->gray, t->across, t->down);
  float sums[3];
  sum_gradient(t->across, t->down, sums);
  t->A << sums[0], sums[1], sums[1], sums[2];
  const float half = 0.5f * (sums[0] + sums[2]), off = std::hypot(0.5f * (sums[0] - sums[2]), sums[1]);
  return half - off > kMinEigenvalue * kPixels;
}

enum class Search { kDone, kOutside };

// Moves `at` in one level until the patch there is that of the template.
Search search(const Template& t, const FlowImage& image, int level, Eigen::Vector2f* at) {
  PatchValues shown = {};
  const Eigen::Matrix2f inverse = t.A.inverse();
  Eigen::Vector2f before = Eigen::Vector2f::Zero();
  for (int i = 0; i < kIterations; ++i) {
    if (!sample<kSide>(image.levels()[size_t(level)], *at, shown)) return Search::kOutside;
    Mismatch m;
    compare(t, shown, image.gain(), image.offset(), &m);
    const Eigen::Vector2f step = -inverse * Eigen::Vector2f(m.across, m.down);
    *at += step;
    if (step.squaredNorm() <= kMinStepPx * kMinStepPx) break;
    if (i > 0 && (step + before).cwiseAbs().maxCoeff() < kTurnsBackPx) {
      *at -= 0.5f * step;
      break;
    }
    before = step;
  }
  return Search::kDone;
}

}  // namespace

FlowImage::FlowImage(std::shared_ptr<const FramePyramid> frame, int level) : frame_(std::move(frame)) {
  for (int l = level; l < int(frame_->levels.size()) && int(levels_.size()) < kLevels; ++l)
    levels_.push_back(frame_->levels[size_t(l)].gray.view());
  coarser_.reserve(kLevels);
  while (int(levels_.size()) < kLevels) {
    const ImageView<uint8_t>& finer = levels_.back();
    Plane<uint8_t>& half = coarser_.emplace_back((finer.width + 1) / 2, (finer.height + 1) / 2);
    cv::Mat to = as_mat(half);
    cv::pyrDown(as_mat(finer), to, to.size());
    levels_.push_back(half.view());
  }
  // Of the second level: enough pixels.
  cv::Scalar mean, deviation;
  cv::meanStdDev(as_mat(levels_[1]), mean, deviation);
  gain_ = float(kUsualContrast / std::max(deviation[0], kMinContrast));
  offset_ = float(kUsualMean) - gain_ * float(mean[0]);
}

std::optional<Eigen::Vector2f> follow_patch(const FlowImage& before, const FlowImage& now,
                                            const Eigen::Vector2f& from, const Eigen::Vector2f& start) {
  Eigen::Vector2f moved = start - from;
  Template t;
  for (int level = kLevels - 1; level >= 0; --level) {
    const float scale = 1 / float(1 << level);
    // A coarse level that shows no corner, or not enough of the patch, is passed over.
    bool is_found = take_template(before, level, scale * from, &t);
    Eigen::Vector2f at = scale * (from + moved);
    is_found = is_found && search(t, now, level, &at) == Search::kDone && at.allFinite();
    if (is_found) moved = at / scale - from;
    if (!is_found && level == 0) return std::nullopt;
  }
  PatchValues shown = {};
  const Eigen::Vector2f found = from + moved;
  if (!sample<kSide>(now.levels()[0], found, shown)) return std::nullopt;
  return mean_difference(t, shown, now.gain(), now.offset()) < kMaxDifference ? std::optional(found)
                                                                              : std::nullopt;
}

}  // namespace edgevo
