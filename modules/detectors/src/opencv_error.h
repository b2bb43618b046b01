#pragma once
// OpenCV's own words made part of ours.
#include <opencv2/core.hpp>
#include <string>

namespace edgevo {

/// What went wrong, without file and line of OpenCV's sources, at most 120 characters.
inline std::string one_line(const cv::Exception& e) {
  std::string text = e.err.substr(0, 120);
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

}  // namespace edgevo
