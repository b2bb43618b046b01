// SPDX-License-Identifier: BSD-3-Clause
#include "plain_png.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "png_filters.h"

namespace edgevo {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
// Of a chunk: length, type and checksum, in bytes.
constexpr size_t kAround = 12;
constexpr uint32_t kMaxPixels = 1 << 28;

uint32_t big_endian(const char* at) {
  uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | uint8_t(at[i]);
  return value;
}

struct PlainPng {
  uint32_t width = 0, height = 0;
  int channels = 0;
  std::string deflated;

  size_t row_bytes() const { return size_t(width) * size_t(channels); }
};

// Whether a chunk does not change the decoded pixels: in lower case are those that a decoder may skip.
bool is_optional(std::string_view type) { return type[0] >= 'a' && type != "tRNS"; }

bool read_header(std::string_view data, PlainPng* png) {
  if (data.size() != 13) return false;
  constexpr char kGray = 0, kRgb = 2;
  const char depth = data[8], colour = data[9], compression = data[10], filter = data[11],
             interlace = data[12];
  if (depth != 8 || (colour != kGray && colour != kRgb) || compression != 0 || filter != 0 || interlace != 0)
    return false;
  png->width = big_endian(data.data()), png->height = big_endian(data.data() + 4);
  png->channels = colour == kRgb ? 3 : 1;
  return png->width > 0 && png->height > 0 && uint64_t(png->width) * png->height <= kMaxPixels;
}

std::optional<PlainPng> read_chunks(std::string_view bytes) {
  if (bytes.substr(0, kSignature.size()) != kSignature) return std::nullopt;
  PlainPng png;
  png.deflated.reserve(bytes.size());
  bool has_header = false;
  for (size_t at = kSignature.size(); at + kAround <= bytes.size();) {
    const size_t length = big_endian(&bytes[at]);
    if (length > bytes.size() - at - kAround) break;
    const std::string_view type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, length);
    if (libdeflate_crc32(0, type.data(), 4 + length) != big_endian(data.data() + length)) break;
    if (has_header != (type != "IHDR")) break;
    if (type == "IEND") return png;
    if (type == "IHDR")
      has_header = read_header(data, &png);
    else if (type == "IDAT")
      png.deflated += data;
    else if (!is_optional(type))
      break;
    if (!has_header) break;
    at += kAround + length;
  }
  return std::nullopt;
}

// All rows, each after the number of its filter; null if the data are not of exactly that size.
std::unique_ptr<uint8_t[]> inflate_rows(const PlainPng& png) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  const size_t size = (png.row_bytes() + 1) * png.height;
  std::unique_ptr<uint8_t[]> rows(new uint8_t[size]);  // not initialised
  if (!inflater || libdeflate_zlib_decompress(inflater.get(), png.deflated.data(), png.deflated.size(),
                                              rows.get(), size, nullptr) != LIBDEFLATE_SUCCESS)
    rows.reset();
  return rows;
}

}  // namespace

cv::Mat decode_plain_png(std::string_view bytes) {
  const std::optional<PlainPng> png = read_chunks(bytes);
  if (!png) return {};
  const std::unique_ptr<uint8_t[]> rows = inflate_rows(*png);
  if (!rows) return {};
  cv::Mat pixels(int(png->height), int(png->width), CV_8UC(png->channels));
  if (!unfilter_rows(rows.get(), pixels.rows, int(png->row_bytes()), png->channels, pixels.ptr(),
                     std::ptrdiff_t(pixels.step)))
    return {};
  if (png->channels == 3) cv::cvtColor(pixels, pixels, cv::COLOR_RGB2BGR);
  return pixels;
}

}  // namespace edgevo
