// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/recordings/image_pixels.h"

#include <algorithm>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr int kIsGray = -1;

struct Encoding {
  const char* name;
  int type;     // OpenCV's, of the pixels
  int convert;  // cv::ColorConversionCodes to gray; of a Bayer pattern to colour
};

// OpenCV names a Bayer pattern by its second row from the second column on.
constexpr Encoding kEncodings[] = {
    {"mono8", CV_8UC1, kIsGray},
    {"8UC1", CV_8UC1, kIsGray},
    {"mono16", CV_16UC1, kIsGray},
    {"16UC1", CV_16UC1, kIsGray},
    {"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
    {"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
    {"8UC3", CV_8UC3, cv::COLOR_BGR2GRAY},
    {"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
    {"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
    {"8UC4", CV_8UC4, cv::COLOR_BGRA2GRAY},
    {"rgb16", CV_16UC3, cv::COLOR_RGB2GRAY},
    {"bgr16", CV_16UC3, cv::COLOR_BGR2GRAY},
    {"rgba16", CV_16UC4, cv::COLOR_RGBA2GRAY},
    {"bgra16", CV_16UC4, cv::COLOR_BGRA2GRAY},
    {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2BGR},
    {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2BGR},
    {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2BGR},
    {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2BGR},
    {"bayer_rggb16", CV_16UC1, cv::COLOR_BayerBG2BGR},
    {"bayer_bggr16", CV_16UC1, cv::COLOR_BayerRG2BGR},
    {"bayer_gbrg16", CV_16UC1, cv::COLOR_BayerGR2BGR},
    {"bayer_grbg16", CV_16UC1, cv::COLOR_BayerGB2BGR},
    {"yuv422", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
    {"uyvy", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
    {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
    {"yuyv", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
};

bool is_bayer(const Encoding& encoding) { return std::string(encoding.name).rfind("bayer", 0) == 0; }

const Encoding& encoding_of(const std::string& name, const std::string& where) {
  for (const Encoding& encoding : kEncodings)
    if (name == encoding.name) return encoding;
  throw InputError(where, "images of the encoding '" + name + "' are not read",
                   "read are mono, rgb, bgr, rgba, bgra and Bayer of 8 and 16 bits, yuv422, 16UC1");
}

void check_size(const ImageMessage& m, size_t row, const std::string& where) {
  if (m.width == 0 || m.height == 0)
    throw InputError(where, "the image is empty", "record it again or leave the frame out");
  if (m.step < row)
    throw InputError(
        where, "a row has " + std::to_string(m.step) + " bytes, but its pixels need " + std::to_string(row),
        "");
  const uint64_t needed = uint64_t(m.step) * uint64_t(m.height - 1) + row;
  if (m.pixels.size() < needed)
    throw InputError(where,
                     "the image has " + std::to_string(m.pixels.size()) + " bytes, but its size needs " +
                         std::to_string(needed),
                     "");
}

void swap_bytes(cv::Mat* pixels) {
  auto* bytes = pixels->data;
  const size_t size = pixels->total() * pixels->elemSize();
  for (size_t i = 0; i + 1 < size; i += 2) std::swap(bytes[i], bytes[i + 1]);
}

cv::Mat pixels_of(const ImageMessage& m, int type, const std::string& where) {
  const size_t row = size_t(m.width) * CV_ELEM_SIZE(type);
  check_size(m, row, where);
  cv::Mat pixels(m.height, m.width, type);
  for (int y = 0; y < m.height; ++y) std::memcpy(pixels.ptr(y), m.pixels.data() + size_t(y) * m.step, row);
  if (pixels.depth() == CV_16U && m.is_big_endian) swap_bytes(&pixels);
  return pixels;
}

}  // namespace

std::vector<std::string> image_encodings() {
  std::vector<std::string> names;
  for (const Encoding& encoding : kEncodings) names.emplace_back(encoding.name);
  return names;
}

GrayImage gray_image(const ImageMessage& message, const std::string& where) {
  const Encoding& encoding = encoding_of(message.encoding, where);
  const cv::Mat pixels = pixels_of(message, encoding.type, where);
  cv::Mat gray = pixels;
  if (encoding.convert != kIsGray) cv::cvtColor(pixels, gray, encoding.convert);
  if (is_bayer(encoding)) cv::cvtColor(cv::Mat(gray), gray, cv::COLOR_BGR2GRAY);
  GrayImage image{message.width, message.height, {}};
  if (gray.depth() == CV_16U)
    image.values.assign(gray.ptr<uint16_t>(), gray.ptr<uint16_t>() + gray.total());
  else
    image.pixels.assign(gray.data, gray.data + gray.total());
  return image;
}

}  // namespace edgevo
