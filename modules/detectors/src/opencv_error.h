// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Messages of OpenCV as part of those of edgevo.
#include <opencv2/core.hpp>
#include <string>

namespace edgevo {

/// Message of an exception without file and line of OpenCV's sources, at most 120 characters.
inline std::string one_line(const cv::Exception& e) {
  std::string text = e.err.substr(0, 120);
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

}  // namespace edgevo
