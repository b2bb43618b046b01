// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/image_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/output_file.h"
#include "edgevo/files/image_integrity.h"
#include "gray_conversion.h"
#include "plain_png.h"

namespace edgevo {
namespace {

constexpr const char* kReplaceImage = "restore the image";

std::string read_bytes(const std::string& path) {
  std::error_code ignored;
  const bool is_file = std::filesystem::is_regular_file(path, ignored);  // opening a pipe would wait for ever
  std::ifstream file(is_file ? path : std::string(), std::ios::binary);
  if (!file) throw InputError(path, "the image is missing or cannot be read", kReplaceImage);
  file.seekg(0, std::ios::end);
  std::string bytes(size_t(std::max(std::streamoff(0), std::streamoff(file.tellg()))), '\0');
  file.seekg(0).read(bytes.data(), std::streamsize(bytes.size()));
  bytes.resize(size_t(file.gcount()));
  return bytes;
}

cv::Mat decode(const std::string& bytes) try {
  const cv::Mat encoded(1, int(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  return cv::imdecode(encoded, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
} catch (const cv::Exception&) {
  return {};
}

cv::Mat decode_pixels(const std::string& bytes, const std::string& where) {
  cv::Mat pixels = decode_plain_png(bytes);
  if (!pixels.empty()) return pixels;
  const std::string damage = image_damage(bytes);
  if (!damage.empty()) throw InputError(where, "the image does not decode: " + damage, kReplaceImage);
  pixels = decode(bytes);
  if (pixels.empty()) throw InputError(where, "the image does not decode", kReplaceImage);
  return pixels;
}

cv::Mat read_pixels(const std::string& path) { return decode_pixels(read_bytes(path), path); }

}  // namespace

GrayImage read_gray_image(const std::string& path) {
  const cv::Mat pixels = read_pixels(path);
  if (auto deep = to_deep(pixels, path)) {
    const IntensityScale scale = *decide_intensities(*deep).scale;
    return with_pixels(std::move(*deep), scale);
  }
  return to_gray(pixels, std::nullopt, path);
}

GrayImage read_gray_image(const std::string& path, const std::optional<IntensityScale>& scale) {
  return to_gray(read_pixels(path), scale, path);
}

std::optional<DeepImage> read_deep_image(const std::string& path) { return to_deep(read_pixels(path), path); }

GrayImage decode_gray_image(const std::string& bytes, const std::optional<IntensityScale>& scale,
                            const std::string& where) {
  return to_gray(decode_pixels(bytes, where), scale, where);
}

std::optional<DeepImage> decode_deep_image(const std::string& bytes, const std::string& where) {
  return to_deep(decode_pixels(bytes, where), where);
}

void write_png(const std::string& path, const GrayImage& image) {
  check_pixels(image, path);
  const cv::Mat pixels(image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.pixels.data()));
  std::vector<uint8_t> encoded;
  cv::imencode(".png", pixels, encoded);
  try {
    write_file(path, {reinterpret_cast<const char*>(encoded.data()), encoded.size()});
  } catch (const InputError&) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    throw;
  }
}

}  // namespace edgevo
