// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images of more than 8 bits. Cameras store 10, 12 or 14 bits in files of 16, and infra-red cameras a narrow
// band far from zero: taking the upper 8 bits would leave a handful of gray levels. One linear scaling for a
// whole sequence, decided from some of its images, gives the unit of its values: the gray level. The pixels
// show values outside of it as black or white; edges and patches are taken from the values themselves.
//
//   value = black + per_level * gray, pixel = floor((value - black) / per_level), limited to 0 .. 255
//
// Images of 8 bits are not touched.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/input_decision.h"

namespace edgevo {

/// Fewest bits that may be named by --bits.
constexpr int kMinBits = 8;
/// Most bits of an image.
constexpr int kMaxBits = 16;
/// Number of images from which the scaling of a sequence is decided.
constexpr int kIntensitySamples = 10;

/// Gray image as a file of more than 8 bits holds it.
struct DeepImage {
  /// Size in pixels.
  int width = 0, height = 0;
  /// Values row by row, width * height of them.
  std::vector<uint16_t> values;
};

/// `image` with its pixels by `scale`: 0 for values below it, 255 for those above.
GrayImage with_pixels(DeepImage image, const IntensityScale& scale);

/// How often each value occurs in some images.
class IntensityCount {
 public:
  /// Adds the values of an image.
  void add(const DeepImage& image);
  /// Number of images added.
  int images() const { return images_; }
  /// Smallest value that at least `share` (0 to 1) of all values do not exceed; 0 without images.
  int quantile(double share) const;
  /// Largest value; 0 without images.
  int largest() const { return quantile(1); }
  /// Number of lowest bits that are 0 in all values; 16 if all values are 0.
  int unused_low_bits() const;

 private:
  std::vector<int64_t> count_ = std::vector<int64_t>(65536);
  int64_t total_ = 0;
  int images_ = 0;
};

/// How the images of a sequence are read.
struct Intensities {
  /// Scaling; nothing for images of 8 bits.
  std::optional<IntensityScale> scale;
  /// What was decided, for the user; nothing for images of 8 bits.
  std::optional<InputDecision> decision;
};

/// Decides on the scaling of a sequence from the values of some of its images. `bits`: number of significant
/// bits that the user gave, or 0; `origin`: which images these are, as in "10 images of the sequence".
/// Without images of more than 8 bits (`count` is empty) there is no scaling. Throws InputError for bits that
/// are out of range, or that are given for images of 8 bits.
///
/// By their largest value, the images have 8, 10, 12, 14 or 16 bits. If they use few of the gray levels that
/// this leaves, their own range with a margin becomes black to white.
Intensities decide_intensities(const IntensityCount& count, int bits, const std::string& origin);

/// Decides on a sequence of image files, by up to kIntensitySamples of them from its beginning to its end.
/// The first that decodes shows whether they have 8 bits; then no other is read. Throws InputError for bits
/// as above.
Intensities decide_intensities(const std::vector<std::string>& paths, int bits);

/// Decides on one image by itself.
Intensities decide_intensities(const DeepImage& image);

}  // namespace edgevo
