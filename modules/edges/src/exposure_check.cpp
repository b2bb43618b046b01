// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/exposure_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
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

// By how much rows next to each other differ more than rows two apart. In a view they differ less; noise
// alone makes no difference, within the scatter of the rows.
class Alternation {
 public:
  void add(int64_t next, int64_t second) {
    const double more = double(next - second);
    sum_ += more, squares_ += more * more;
  }
  // Beyond what noise gives: one image in 700, two that follow each other never.
  bool is_certain() const {
    constexpr double kSigmas = 3;
    return sum_ > 0 && sum_ * sum_ > kSigmas * kSigmas * squares_;
  }

 private:
  double sum_ = 0, squares_ = 0;
};

bool do_rows_alternate(const View& image) {
  Alternation rows;
  for (int y = 2; y < image.height; ++y)
    rows.add(difference(image.row(y - 1), image.row(y - 2), image.width),
             difference(image.row(y), image.row(y - 2), image.width));
  return rows.is_certain();
}

bool do_columns_alternate(const View& image) {
  Alternation columns;
  for (int y = 0; y < image.height; ++y) {
    const uint8_t* row = image.row(y);
    columns.add(difference(row + 1, row, image.width - 2), difference(row + 2, row, image.width - 2));
  }
  return columns.is_certain();
}

// Every second row is of another time, or every second pixel of another colour.
ImageFault pattern_of(const View& image) {
  if (image.width < 3 || !do_rows_alternate(image)) return ImageFault::kNone;
  return do_columns_alternate(image) ? ImageFault::kMosaic : ImageFault::kInterlaced;
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

// Rows that were equal in the comparison before this one as well are fixed to the camera, or it stands.
ImageRows ExposureCheck::rows_of(Earlier* earlier, const View& image) {
  constexpr double kShare = 0.02;  // of the texture: fewer rows do no harm, as a sky that is white
  if (earlier->pixels.empty()) return {};
  std::vector<bool> equal(size_t(image.height), false);
  for (int y = 0; y < image.height; ++y)
    equal[size_t(y)] =
        std::equal(image.row(y), image.row(y) + image.width, &earlier->pixels[size_t(y * image.width)]);
  ImageRows old = end_of_equal(equal);
  const bool is_new = !earlier->equal.empty() && !any_of(earlier->equal, old);
  const ImageRows all{0, image.height};
  if (!is_new || double(texture_of(image, old)) < kShare * double(texture_of(image, all))) old = {};
  earlier->equal = std::move(equal);
  return old;
}

void ExposureCheck::keep(const std::vector<uint8_t>& pixels) {
  for (size_t i = before_.size() - 1; i > 0; --i) before_[i].pixels.swap(before_[i - 1].pixels);
  before_[0].pixels = pixels;
}

ImageExposure ExposureCheck::add(const GrayImage& image) {
  const View view = image.view();
  if (width_ != image.width || height_ != image.height) before_ = {};
  width_ = image.width, height_ = image.height;
  if (is_blank(image)) return {std::exchange(was_blank_, true) ? ImageFault::kNone : ImageFault::kBlank, {}};
  was_blank_ = false;
  std::array<ImageRows, kBuffers> old;
  for (size_t i = 0; i < kBuffers; ++i) old[i] = rows_of(&before_[i], view);
  keep(image.pixels);
  if (old[0].size() == image.height) return {ImageFault::kRepeated, {}};
  const auto torn = std::find_if(old.begin(), old.end(), [](const ImageRows& rows) { return !rows.empty(); });
  if (torn != old.end() && torn->size() < image.height) return {ImageFault::kTorn, *torn};
  if (pattern_ != ImageFault::kNone) return {pattern_, {}};
  const ImageFault found = pattern_of(view);
  if (found == newest_pattern_ && found != ImageFault::kNone) pattern_ = found;
  newest_pattern_ = found;
  return {found, {}};
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

// Weights 1, 2, 1 down and across: all four places of the mosaic count alike everywhere.
GrayImage without_mosaic(const GrayImage& image) {
  GrayImage gray = image;
  const auto smooth = [&](auto* values, int type) {
    cv::Mat seen(image.height, image.width, type, values);
    cv::GaussianBlur(seen, seen, {3, 3}, 0);
  };
  smooth(gray.pixels.data(), CV_8UC1);
  if (gray.is_deep()) smooth(gray.values.data(), CV_16UC1);
  return gray;
}

}  // namespace edgevo
