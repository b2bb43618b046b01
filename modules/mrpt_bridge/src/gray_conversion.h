// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The only conversion of decoded pixels to a GrayImage, whether they come from a file or from a rawlog.
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "edgevo/core/image.h"
#include "edgevo/mrpt_bridge/intensities.h"

namespace edgevo {

/// Values of `pixels` if they are gray, BGR or BGRA of 16 bits; nullopt if they have 8. Throws InputError
/// (opened by `where`) for anything else.
std::optional<DeepImage> to_deep(const cv::Mat& pixels, const std::string& where);

/// Gray image of `pixels`: gray, BGR or BGRA, of 8 bits without a `scale` and of 16 with one. Throws
/// InputError (opened by `where`) for anything else.
GrayImage to_gray(const cv::Mat& pixels, const std::optional<IntensityScale>& scale,
                  const std::string& where);

}  // namespace edgevo
