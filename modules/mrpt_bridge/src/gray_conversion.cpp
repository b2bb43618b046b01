// SPDX-License-Identifier: BSD-3-Clause
#include "gray_conversion.h"

#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"

namespace edgevo {

GrayImage to_gray(const cv::Mat& pixels, const std::string& where) {
  if (pixels.empty()) throw InputError(where, "the image is empty", "record it again or leave the frame out");
  if (pixels.depth() != CV_8U)
    throw InputError(where, "the image is not 8 bits deep", "convert it to 8 bits");
  GrayImage gray{pixels.cols, pixels.rows, std::vector<uint8_t>(pixels.total())};
  cv::Mat target(pixels.rows, pixels.cols, CV_8UC1, gray.pixels.data());
  switch (pixels.channels()) {
    case 1:
      pixels.copyTo(target);
      break;
    case 3:
      cv::cvtColor(pixels, target, cv::COLOR_BGR2GRAY);
      break;
    case 4:
      cv::cvtColor(pixels, target, cv::COLOR_BGRA2GRAY);
      break;
    default:
      throw InputError(where, "the image has " + std::to_string(pixels.channels()) + " channels",
                       "gray and colour images are read");
  }
  return gray;
}

}  // namespace edgevo
