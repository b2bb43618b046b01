// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/exposure_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <type_traits>
#include <utility>

namespace edgevo {
namespace {

using View = ImageView<uint8_t>;

// Standard deviation of every fourth pixel, in steps of the image's values.
double contrast_of(const GrayImage& image) {
  constexpr int kStep = 4;
  double n = 0, sum = 0, squares = 0;
  for (int y = 0; y < image.height; y += kStep)
    for (int x = 0; x < image.width; x += kStep) {
      const size_t at = size_t(y * image.width + x);
      const double v = image.is_deep() ? double(image.values[at]) : double(image.pixels[at]);
      n += 1, sum += v, squares += v * v;
    }
  return n > 0 ? std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n))) : 0;
}

int64_t difference(const uint8_t* a, const uint8_t* b, int width) {
  int64_t sum = 0;
  for (int x = 0; x < width; ++x) sum += std::abs(int(a[x]) - int(b[x]));
  return sum;
}

// In a view, rows next to each other are more alike than rows two apart; where every second one is of another
// time they are less.
bool is_combed(const View& image) {
  int64_t next = 0, second = 0;
  for (int y = 2; y < image.height; ++y) {
    next += difference(image.row(y - 1), image.row(y - 2), image.width);
    second += difference(image.row(y), image.row(y - 2), image.width);
  }
  return next > second;
}

int64_t texture_of(const View& image, const ImageRows& rows) {
  int64_t sum = 0;
  for (int y = rows.begin; y < rows.end; ++y)
    sum += difference(image.row(y) + 1, image.row(y), image.width - 1);
  return sum;
}

// Equal rows at the top or the bottom, whichever are more; all of them: {0, height}.
ImageRows end_of_equal(const std::vector<bool>& equal) {
  const int height = int(equal.size());
  const int top = int(std::find(equal.begin(), equal.end(), false) - equal.begin());
  const int bottom = int(std::find(equal.rbegin(), equal.rend(), false) - equal.rbegin());
  return top >= bottom ? ImageRows{0, top} : ImageRows{height - bottom, height};
}

bool any_of(const std::vector<bool>& values, const ImageRows& rows) {
  return std::find(values.begin() + rows.begin, values.begin() + rows.end, true) != values.begin() + rows.end;
}

}  // namespace

// It shows noise alone. A view that is only dark, as after a jump of the exposure, is no blank.
bool ExposureCheck::is_blank(const GrayImage& image) {
  constexpr double kShare = 0.1;  // of the contrast before
  constexpr double kNoise = 4;    // steps
  const double contrast = contrast_of(image);
  if (contrast < std::min(kNoise, kShare * contrast_)) return true;
  contrast_ = contrast;
  return false;
}

ImageRows ExposureCheck::old_rows(const View& image) {
  constexpr double kShare = 0.02;  // of the texture: fewer rows do no harm, as a sky that is white
  std::vector<bool> equal(size_t(image.height), false);
  if (!before_.empty())
    for (int y = 0; y < image.height; ++y)
      equal[size_t(y)] =
          std::equal(image.row(y), image.row(y) + image.width, &before_[size_t(y * image.width)]);
  ImageRows old = end_of_equal(equal);
  const bool is_new = !equal_before_.empty() && !any_of(equal_before_, old);
  const ImageRows all{0, image.height};
  if (!is_new || double(texture_of(image, old)) < kShare * double(texture_of(image, all))) old = {};
  equal_before_ = before_.empty() ? std::vector<bool>() : std::move(equal);
  return old;
}

ImageExposure ExposureCheck::add(const GrayImage& image) {
  const View view = image.view();
  if (before_.size() != image.pixels.size()) before_.clear(), equal_before_.clear();
  if (is_blank(image)) return {std::exchange(was_blank_, true) ? ImageFault::kNone : ImageFault::kBlank, {}};
  was_blank_ = false;
  const ImageRows old = old_rows(view);
  before_ = image.pixels;
  if (old.size() == image.height) return {ImageFault::kRepeated, {}};
  if (!old.empty()) return {ImageFault::kTorn, old};
  const bool combed = is_combed(view);
  is_interlaced_ = is_interlaced_ || (combed && was_combed_);
  was_combed_ = combed;
  return {combed || is_interlaced_ ? ImageFault::kInterlaced : ImageFault::kNone, {}};
}

GrayImage first_field(const GrayImage& image) {
  GrayImage field = image;
  const auto mean_of_rows = [&](auto* values) {
    const int w = image.width;
    for (int y = 1; y < image.height; y += 2) {
      const auto *above = values + (y - 1) * w, *below = y + 1 < image.height ? values + (y + 1) * w : above;
      for (int x = 0; x < w; ++x)
        values[y * w + x] = std::decay_t<decltype(*values)>((int(above[x]) + int(below[x]) + 1) / 2);
    }
  };
  mean_of_rows(field.pixels.data());
  if (field.is_deep()) mean_of_rows(field.values.data());
  return field;
}

}  // namespace edgevo
