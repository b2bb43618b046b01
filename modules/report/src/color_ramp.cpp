// SPDX-License-Identifier: BSD-3-Clause
#include "color_ramp.h"

#include <opencv2/imgproc.hpp>

namespace edgevo {

const std::vector<std::array<uint8_t, 3>>& color_ramp() {
  static const std::vector<std::array<uint8_t, 3>> ramp = [] {
    cv::Mat steps(1, 256, CV_8U), colors;
    for (int i = 0; i < 256; ++i) steps.at<uchar>(0, i) = uchar(i);
    cv::applyColorMap(steps, colors, cv::COLORMAP_TURBO);
    std::vector<std::array<uint8_t, 3>> rgb;
    for (const cv::Vec3b& c : cv::Mat_<cv::Vec3b>(colors)) rgb.push_back({c[2], c[1], c[0]});
    return rgb;
  }();
  return ramp;
}

std::string color_ramp_css() {
  std::string css = "linear-gradient(to right";
  for (size_t i = 0; i < color_ramp().size(); i += 15) {
    const auto& [red, green, blue] = color_ramp()[i];
    css += ",rgb(" + std::to_string(red) + ',' + std::to_string(green) + ',' + std::to_string(blue) + ')';
  }
  return css + ')';
}

}  // namespace edgevo
