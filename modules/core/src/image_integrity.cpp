#include "edgevo/core/image_integrity.h"

#include <zlib.h>

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

// A JPEG is a row of segments with their lengths up to the start of scan; in the scan data 0xFF stands only
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

}  // namespace

std::string image_damage(std::string_view bytes) {
  if (bytes.empty()) return "the file is empty";
  if (bytes.substr(0, 8) == kPngSignature) return png_damage(bytes);
  if (bytes.substr(0, 2) == "\xFF\xD8") return jpeg_damage(bytes);
  return {};
}

}  // namespace edgevo
