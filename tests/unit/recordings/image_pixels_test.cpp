// SPDX-License-Identifier: BSD-3-Clause
// Pixels of each encoding against OpenCV's gray of the same colours.
#include "edgevo/recordings/image_pixels.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "support/recording_messages.h"

namespace edgevo::test {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 22, kHeight = 14;

cv::Mat colours() {
  cv::Mat bgr(kHeight, kWidth, CV_8UC3);
  cv::randu(bgr, 0, 256);
  return bgr;
}

cv::Mat gray_of(const cv::Mat& bgr) {
  cv::Mat gray;
  cv::cvtColor(bgr, gray, cv::COLOR_BGR2GRAY);
  return gray;
}

std::string bytes_of(const cv::Mat& pixels) {
  return {reinterpret_cast<const char*>(pixels.data), pixels.total() * pixels.elemSize()};
}

// As a driver would send it, with three bytes behind each row.
GrayImage read(const cv::Mat& pixels, const std::string& encoding, bool is_big_endian = false) {
  constexpr size_t kPadding = 3;
  const size_t row = size_t(pixels.cols) * pixels.elemSize();
  std::string data;
  for (int y = 0; y < pixels.rows; ++y)
    data += std::string(pixels.ptr<char>(y), row) + std::string(kPadding, '\x55');
  const ImageMessage message{{},  pixels.cols, pixels.rows, encoding, is_big_endian, uint32_t(row + kPadding),
                             data};
  return gray_image(message, "here");
}

std::string pixels_of(const GrayImage& image) { return {image.pixels.begin(), image.pixels.end()}; }

TEST(ImagePixels, ColourIsTheGrayOfAnImageFile) {
  const cv::Mat bgr = colours();
  const std::string expected = bytes_of(gray_of(bgr));
  cv::Mat other;
  EXPECT_EQ(pixels_of(read(bgr, "bgr8")), expected);
  cv::cvtColor(bgr, other, cv::COLOR_BGR2RGB);
  EXPECT_EQ(pixels_of(read(other, "rgb8")), expected);
  cv::cvtColor(bgr, other, cv::COLOR_BGR2BGRA);
  EXPECT_EQ(pixels_of(read(other, "bgra8")), expected);
  cv::cvtColor(bgr, other, cv::COLOR_BGR2RGBA);
  EXPECT_EQ(pixels_of(read(other, "rgba8")), expected);
  EXPECT_EQ(pixels_of(read(gray_of(bgr), "mono8")), expected);
}

TEST(ImagePixels, LumaOfYuv) {
  const cv::Mat luma = gray_of(colours());
  cv::Mat first(kHeight, kWidth, CV_8UC2, cv::Scalar(128, 128)), second = first.clone();
  cv::insertChannel(luma, first, 0);
  cv::insertChannel(luma, second, 1);
  EXPECT_EQ(pixels_of(read(first, "yuv422_yuy2")), bytes_of(luma));
  EXPECT_EQ(pixels_of(read(second, "yuv422")), bytes_of(luma));
}

// An image of one colour shows which place of the pattern is taken for which colour.
TEST(ImagePixels, BayerPatterns) {
  const cv::Vec3b bgr(40, 90, 200);
  const int expected = gray_of(cv::Mat(1, 1, CV_8UC3, cv::Scalar(bgr))).at<uint8_t>(0, 0);
  for (const std::string pattern : {"rggb", "bggr", "gbrg", "grbg"}) {
    cv::Mat raw(kHeight, kWidth, CV_8UC1);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const char colour = pattern[size_t(y % 2 * 2 + x % 2)];
        raw.at<uint8_t>(y, x) = bgr[colour == 'b' ? 0 : colour == 'g' ? 1 : 2];
      }
    for (const uint8_t pixel : read(raw, "bayer_" + pattern + "8").pixels)
      ASSERT_NEAR(pixel, expected, 1) << pattern;
  }
}

TEST(ImagePixels, SixteenBitsOfEitherByteOrder) {
  const cv::Mat deep = (cv::Mat_<uint16_t>(1, 3) << 1, 256, 65535);
  const std::vector<uint16_t> expected{1, 256, 65535}, swapped{256, 1, 65535};
  for (const char* encoding : {"mono16", "16UC1"}) {
    EXPECT_EQ(read(deep, encoding).values, expected);
    EXPECT_EQ(read(deep, encoding, true).values, swapped);
    EXPECT_TRUE(read(deep, encoding).pixels.empty());
  }
}

TEST(ImagePixels, EveryEncodingIsReadAtEverySmallSize) {
  for (const std::string& encoding : image_encodings())
    for (int width = 1; width <= 4; ++width)
      for (int height = 1; height <= 4; ++height) {
        const std::string data(size_t(width * height) * 8, 'x');
        const ImageMessage message{{}, width, height, encoding, false, uint32_t(width) * 8, data};
        EXPECT_EQ(gray_image(message, "x").width, width) << encoding;
      }
}

TEST(ImagePixels, WhatDoesNotFitIsRefused) {
  const auto message = [](const ImageMessage& image) {
    try {
      gray_image(image, "here");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(message({{}, 2, 1, "32FC1", false, 8, "12345678"}),
              HasSubstr("here: images of the encoding '32FC1' are not read"));
  EXPECT_THAT(message({{}, 2, 2, "mono8", false, 2, "123"}), HasSubstr("has 3 bytes, but its size needs 4"));
  EXPECT_THAT(message({{}, 2, 2, "mono8", false, 1, "1234"}),
              HasSubstr("a row has 1 bytes, but its pixels need 2"));
  EXPECT_THAT(message({{}, 0, 2, "mono8", false, 1, ""}), HasSubstr("the image is empty"));
  EXPECT_EQ(message({{}, 2, 2, "mono8", false, 2, "1234"}), "accepted");
}

}  // namespace
}  // namespace edgevo::test
