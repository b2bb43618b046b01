// SPDX-License-Identifier: BSD-3-Clause
#include "gray_conversion.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

void check_kind(const cv::Mat& pixels, const std::string& where) {
  if (pixels.empty()) throw InputError(where, "the image is empty", "record it again or leave the frame out");
  if (pixels.depth() != CV_8U && pixels.depth() != CV_16U)
    throw InputError(where, "its values are signed or not whole numbers",
                     "convert it to 8 or 16 bits, unsigned");
  const int channels = pixels.channels();
  if (channels != 1 && channels != 3 && channels != 4)
    throw InputError(where, "the image has " + std::to_string(channels) + " channels",
                     "gray and colour images are read");
}

void put_gray(const cv::Mat& pixels, cv::Mat target) {
  if (pixels.channels() == 1)
    pixels.copyTo(target);
  else
    cv::cvtColor(pixels, target, pixels.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
}

}  // namespace

std::optional<DeepImage> to_deep(const cv::Mat& pixels, const std::string& where) {
  check_kind(pixels, where);
  if (pixels.depth() == CV_8U) return std::nullopt;
  DeepImage deep{pixels.cols, pixels.rows, std::vector<uint16_t>(pixels.total())};
  put_gray(pixels, cv::Mat(pixels.rows, pixels.cols, CV_16UC1, deep.values.data()));
  return deep;
}

GrayImage to_gray(const cv::Mat& pixels, const std::optional<IntensityScale>& scale,
                  const std::string& where) {
  std::optional<DeepImage> deep = to_deep(pixels, where);
  if (deep.has_value() != scale.has_value())
    throw InputError(where,
                     std::string("the image has ") + (deep ? "16" : "8") +
                         " bits, but the first images have " + (deep ? "8" : "16"),
                     "convert all to the same depth");
  if (deep) return with_pixels(std::move(*deep), *scale);
  if (pixels.channels() == 1 && pixels.isContinuous())
    return {pixels.cols, pixels.rows, {pixels.data, pixels.data + pixels.total()}};
  GrayImage gray{pixels.cols, pixels.rows, std::vector<uint8_t>(pixels.total())};
  put_gray(pixels, cv::Mat(pixels.rows, pixels.cols, CV_8UC1, gray.pixels.data()));
  return gray;
}

}  // namespace edgevo
