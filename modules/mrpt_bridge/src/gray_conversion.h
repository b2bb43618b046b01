#pragma once
// The one way from decoded pixels to a GrayImage, whether they come from a file or out of a rawlog.
#include <opencv2/core.hpp>
#include <string>

#include "edgevo/core/image.h"

namespace edgevo {

/// `pixels`: 8 bits, one channel, or BGR, or BGRA. Throws InputError (opened by `where`) for anything else.
GrayImage to_gray(const cv::Mat& pixels, const std::string& where);

}  // namespace edgevo
