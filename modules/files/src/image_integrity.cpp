// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/files/image_integrity.h"

#include <zlib.h>

#include <cctype>
#include <cstdint>

namespace edgevo {
namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
constexpr const char* kCutShort = "the file is cut short";

uint32_t big_endian(std::string_view bytes, size_t at, int count) {
  uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | uint8_t(bytes[at + i]);
  return value;
}

// A PNG is a row of chunks: length, type, data, checksum of type and data; IEND closes it.
std::string png_damage(std::string_view bytes) {
  size_t at = kPngSignature.size();
  while (at + 12 <= bytes.size()) {
    const size_t length = big_endian(bytes, at, 4);
    if (length > bytes.size() - at - 12) return kCutShort;
    const std::string_view type = bytes.substr(at + 4, 4);
    const auto* data = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    if (crc32(0, data, uInt(length + 4)) != big_endian(bytes, at + 8 + length, 4))
      return "the checksum of its data is wrong";
    if (type == "IEND") return {};
    at += 12 + length;
  }
  return kCutShort;
}

// A JPEG is a row of segments with their lengths up to the start of scan; in the scan data 0xFF occurs only
// before markers, and the end-of-image marker closes it.
std::string jpeg_damage(std::string_view bytes) {
  size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (uint8_t(bytes[at]) != 0xFF) return "a marker of its header is wrong";
    const uint8_t marker = uint8_t(bytes[at + 1]);
    if (marker == 0xFF) {  // padding
      ++at;
      continue;
    }
    if (marker == 0xDA) return bytes.find("\xFF\xD9", at) == std::string_view::npos ? kCutShort : "";
    at += 2 + big_endian(bytes, at + 2, 2);
  }
  return kCutShort;
}

// Reads the numbers of a PNM's header; a comment extends from # to the end of its line.
class PnmHeader {
 public:
  explicit PnmHeader(std::string_view bytes) : bytes_(bytes) {}

  /// Next number; 0 if there is none or it is larger than in any image.
  uint64_t next() {
    constexpr uint64_t kMax = 1 << 24;
    skip_space();
    uint64_t value = 0;
    for (; at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9' && value <= kMax; ++at_)
      value = 10 * value + uint64_t(bytes_[at_] - '0');
    return value <= kMax ? value : 0;
  }
  /// Offset of the pixels: one white space ends the header.
  uint64_t bytes_left() const { return at_ < bytes_.size() ? bytes_.size() - at_ - 1 : 0; }

 private:
  void skip_space() {
    bool in_comment = false;
    for (; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '#') in_comment = true;
      if (c == '\n') in_comment = false;
      if (!in_comment && !std::isspace(uint8_t(c))) return;
    }
  }
  std::string_view bytes_;
  size_t at_ = 2;
};

// P1 to P3 are text, P4 to P6 binary; P1 and P4 have bits and no maximum value.
std::string pnm_damage(std::string_view bytes) {
  PnmHeader header(bytes);
  const char kind = bytes[1];
  const bool has_bits = kind == '1' || kind == '4';
  const uint64_t width = header.next(), height = header.next(), most = has_bits ? 1 : header.next();
  if (width == 0 || height == 0 || most == 0 || most > 65535) return "its header is wrong";
  const uint64_t channels = kind == '3' || kind == '6' ? 3 : 1;
  uint64_t row = width * channels;  // in text, at least a digit each
  if (kind == '4') row = (width + 7) / 8;
  if (kind > '4' && most > 255) row *= 2;
  return header.bytes_left() < row * height ? kCutShort : "";
}

// The size of the whole file follows the two letters.
std::string bmp_damage(std::string_view bytes) {
  if (bytes.size() < 26) return kCutShort;
  uint64_t size = 0;
  for (int i = 3; i >= 0; --i) size = size << 8 | uint8_t(bytes[size_t(2 + i)]);
  return size > bytes.size() ? kCutShort : "";
}

bool is_pnm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
         std::isspace(uint8_t(bytes[2]));
}

}  // namespace

std::string image_damage(std::string_view bytes) {
  if (bytes.empty()) return "the file is empty";
  if (bytes.substr(0, 8) == kPngSignature) return png_damage(bytes);
  if (bytes.substr(0, 2) == "\xFF\xD8") return jpeg_damage(bytes);
  if (bytes.substr(0, 2) == "BM") return bmp_damage(bytes);
  if (is_pnm(bytes)) return pnm_damage(bytes);
  return {};
}

}  // namespace edgevo
