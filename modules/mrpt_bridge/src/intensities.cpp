// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/intensities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/image_file.h"

namespace edgevo {
namespace {

constexpr int kValues = 65536;
// The range of a sequence's values, without its darkest and brightest pixels: defects, lamps, markers.
constexpr double kDarkest = 1e-3, kBrightest = 1 - 1e-3;
// Fewer gray levels than these leave too few edges; 12 bits read by the upper 8 of 16 have 16.
constexpr double kFewLevels = 48;
constexpr double kMargin = 0.125;  // of the range, on both sides: exposure and temperature drift

std::string grouped(int value) {
  std::string digits = std::to_string(value);
  if (digits.size() > 3) digits.insert(digits.size() - 3, ",");
  return digits;
}

// Cameras have 8, 10, 12, 14 or 16 bits.
int bits_that_hold(int largest) {
  for (int bits = kMinBits; bits < kMaxBits; bits += 2)
    if (largest < 1 << bits) return bits;
  return kMaxBits;
}

IntensityScale scale_of_bits(int bits) { return {0, double(1 << (bits - 8))}; }

std::string name_of(int bits) {
  return std::to_string(bits) + " bits" + (bits < kMaxBits ? " in 16-bit images" : "");
}

std::string largest_of(const IntensityCount& count, const std::string& origin) {
  return "the largest value of " + origin + " is " + grouped(count.largest());
}

// 12 bits stored in the upper ones of 16, in a dark scene: no camera has 14 bits of which the lowest 4 are
// unused.
bool is_left_aligned_12(const IntensityCount& count) {
  return count.unused_low_bits() == 4 && count.largest() >= 1 << 12;
}

IntensityScale scale_of_range(double low, double high) {
  const double margin = kMargin * (high - low);
  const double black = std::max(0.0, std::floor(low - margin));
  return {black, std::max(1.0, (high + margin - black) / 255)};
}

Intensities by_range(int low, int high, int bits, const std::string& origin) {
  const IntensityScale scale = scale_of_range(low, high);
  const int white = int(std::lround(scale.black + 255 * scale.per_level));
  return {scale, InputDecision{
                     "intensities",
                     "values " + grouped(int(scale.black)) + " to " + grouped(white) + " as black to white",
                     "nearly all of " + origin + " lie from " + grouped(low) + " to " + grouped(high) +
                         ", a small part of " + std::to_string(bits) + " bits; --bits sets others",
                     ""}};
}

Intensities by_bits(const IntensityCount& count, const std::string& origin) {
  const int bits = is_left_aligned_12(count) ? kMaxBits : bits_that_hold(count.largest());
  InputDecision decision{"intensities", name_of(bits), largest_of(count, origin), ""};
  if (count.largest() == 0) {
    decision = {"intensities", name_of(kMaxBits), "", "all of " + origin + " are black; give --bits"};
    return {scale_of_bits(kMaxBits), decision};
  }
  if (is_left_aligned_12(count)) {
    decision.value = "12 bits in the upper ones of 16";
    decision.reason = "the lowest 4 bits of " + origin + " are unused";
  }
  const int low = count.quantile(kDarkest), high = count.quantile(kBrightest);
  const IntensityScale scale = scale_of_bits(bits);
  if (bits > kMinBits && high > low && (high - low) / scale.per_level < kFewLevels)
    return by_range(low, high, bits, origin);
  return {scale, decision};
}

void check_bits(int bits) {
  if (bits == 0 || (bits >= kMinBits && bits <= kMaxBits)) return;
  throw InputError("--bits " + std::to_string(bits), "is out of range", "give 8 to 16");
}

}  // namespace

GrayImage with_pixels(DeepImage image, const IntensityScale& scale) {
  std::array<uint8_t, kValues> gray_of;
  for (int value = 0; value < kValues; ++value)
    gray_of[size_t(value)] =
        uint8_t(std::clamp(std::floor((value - scale.black) / scale.per_level), 0.0, 255.0));
  GrayImage gray{image.width, image.height, std::vector<uint8_t>(image.values.size())};
  std::transform(image.values.begin(), image.values.end(), gray.pixels.begin(),
                 [&](uint16_t value) { return gray_of[value]; });
  gray.values = std::move(image.values);
  gray.scale = scale;
  return gray;
}

void IntensityCount::add(const DeepImage& image) {
  for (const uint16_t value : image.values) ++count_[value];
  total_ += int64_t(image.values.size());
  ++images_;
}

int IntensityCount::quantile(double share) const {
  const double wanted = share * double(total_);
  int64_t below = 0;
  for (int value = 0; value < kValues; ++value) {
    below += count_[size_t(value)];
    if (below > 0 && double(below) >= wanted) return value;
  }
  return 0;
}

int IntensityCount::unused_low_bits() const {
  unsigned used = 0;
  for (int value = 0; value < kValues; ++value)
    if (count_[size_t(value)] > 0) used |= unsigned(value);
  int unused = 0;
  while (unused < kMaxBits && (used >> unused & 1) == 0) ++unused;
  return unused;
}

Intensities decide_intensities(const IntensityCount& count, int bits, const std::string& origin) {
  check_bits(bits);
  if (count.images() == 0) {
    if (bits != 0) throw InputError("--bits", "is of no use: the images have 8 bits", "omit it");
    return {};
  }
  if (bits == 0) return by_bits(count, origin);
  return {scale_of_bits(bits), InputDecision{"intensities", name_of(bits), "as given by --bits", ""}};
}

Intensities decide_intensities(const std::vector<std::string>& paths, int bits) {
  IntensityCount count;
  const size_t wanted = std::min(paths.size(), size_t(kIntensitySamples));
  for (size_t k = 0; k < wanted; ++k) {
    const size_t i = wanted == 1 ? 0 : k * (paths.size() - 1) / (wanted - 1);
    try {
      const auto image = read_deep_image(paths[i]);
      if (!image && count.images() == 0) break;
      if (image) count.add(*image);
    } catch (const InputError&) {  // reported when it is played
    }
  }
  return decide_intensities(count, bits, std::to_string(count.images()) + " images of the sequence");
}

Intensities decide_intensities(const DeepImage& image) {
  IntensityCount count;
  count.add(image);
  return decide_intensities(count, 0, "the image");
}

}  // namespace edgevo
