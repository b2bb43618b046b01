// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The only conversion of decoded pixels to a GrayImage, whether they come from a file or from a rawlog.
#include <opencv2/core.hpp>
#include <string>

#include "edgevo/core/image.h"

namespace edgevo {

/// Gray image of `pixels`: 8 bits, one channel, BGR or BGRA. Throws InputError (opened by `where`) for
/// anything else.
GrayImage to_gray(const cv::Mat& pixels, const std::string& where);

}  // namespace edgevo
