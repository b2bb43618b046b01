// SPDX-License-Identifier: BSD-3-Clause
#include "plain_png.h"

#include <zlib.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <vector>

namespace edgevo {
namespace {

std::string big_endian(uint32_t value) {
  return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
  return big_endian(uint32_t(data.size())) + body + big_endian(uint32_t(sum));
}

std::string deflated(const std::string& data) {
  uLongf size = compressBound(uLong(data.size()));
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
           uLong(data.size()));
  out.resize(size);
  return out;
}

struct PngOptions {
  uint32_t width = 37, height = 41;
  char depth = 8, colour = 0, interlace = 0;
  std::string extra;     // chunks before the data
  int missing = 0;       // bytes that the data are short of
  char last_filter = 4;  // of the first row
};

// Rows of random bytes under all five filters, their data in two chunks.
std::string make_png(const PngOptions& o) {
  std::mt19937 random(3);
  const int channels = o.colour == 2 ? 3 : 1;
  std::string rows;
  for (uint32_t y = 0; y < o.height; ++y) {
    rows += y == 0 ? o.last_filter : char(y % 5);
    for (uint32_t i = 0; i < o.width * uint32_t(channels * o.depth / 8); ++i) rows += char(random() % 256);
  }
  rows.resize(rows.size() - size_t(o.missing));
  const std::string data = deflated(rows);
  const size_t half = data.size() / 2;
  return std::string("\x89PNG\r\n\x1a\n", 8) +
         chunk("IHDR",
               big_endian(o.width) + big_endian(o.height) + o.depth + o.colour + '\0' + '\0' + o.interlace) +
         o.extra + chunk("IDAT", data.substr(0, half)) + chunk("IDAT", data.substr(half)) + chunk("IEND", "");
}

cv::Mat decode_by_opencv(const std::string& png) {
  const std::vector<uint8_t> bytes(png.begin(), png.end());
  return cv::imdecode(bytes, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH);
}

void expect_same(const PngOptions& options) {
  const std::string png = make_png(options);
  const cv::Mat pixels = decode_plain_png(png), expected = decode_by_opencv(png);
  ASSERT_EQ(pixels.type(), expected.type());
  ASSERT_EQ(pixels.size(), expected.size());
  EXPECT_EQ(cv::norm(pixels, expected, cv::NORM_INF), 0);
}

bool is_left_to_others(const PngOptions& options) { return decode_plain_png(make_png(options)).empty(); }

TEST(PlainPng, HasThePixelsOfOpenCvUnderEveryFilter) {
  for (const char colour : {0, 2})
    for (const uint32_t width : {1u, 2u, 37u})
      for (const char first : {0, 1, 2, 3, 4}) {
        PngOptions options;
        options.colour = colour, options.width = width, options.last_filter = first;
        expect_same(options);
      }
}

TEST(PlainPng, SkipsChunksThatDoNotChangePixels) {
  PngOptions options;
  options.extra = chunk("tEXt", "Software") + chunk("gAMA", big_endian(45455));
  expect_same(options);
}

TEST(PlainPng, LeavesOtherFormatsToOtherDecoders) {
  PngOptions deep, interlaced, palette, transparent, empty;
  deep.depth = 16;
  interlaced.interlace = 1;
  palette.colour = 3;
  transparent.extra = chunk("tRNS", std::string("\0\x05", 2));
  empty.width = 0;
  EXPECT_TRUE(is_left_to_others(deep));
  EXPECT_TRUE(is_left_to_others(interlaced));
  EXPECT_TRUE(is_left_to_others(palette));
  EXPECT_TRUE(is_left_to_others(transparent));
  EXPECT_TRUE(is_left_to_others(empty));
  EXPECT_TRUE(decode_plain_png("").empty());
  EXPECT_TRUE(decode_plain_png("P5 2 2 255 abcd").empty());
}

TEST(PlainPng, LeavesDamagedFilesToOtherDecoders) {
  PngOptions is_short, huge, unknown_filter;
  is_short.missing = 1;
  unknown_filter.last_filter = 5;
  EXPECT_TRUE(is_left_to_others(is_short));
  EXPECT_TRUE(is_left_to_others(unknown_filter));
  const std::string whole = make_png({});
  ASSERT_FALSE(decode_plain_png(whole).empty());
  for (size_t size = 0; size < whole.size(); size += 7)
    EXPECT_TRUE(decode_plain_png(std::string_view(whole).substr(0, size)).empty()) << size;
  for (size_t at = 0; at < whole.size(); at += 11) {
    std::string damaged = whole;
    damaged[at] = char(damaged[at] ^ 0x10);
    EXPECT_TRUE(decode_plain_png(damaged).empty()) << at;
  }
}

}  // namespace
}  // namespace edgevo
