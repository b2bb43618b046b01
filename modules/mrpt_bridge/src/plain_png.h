// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A quick decoder for the PNGs that cameras write: 8-bit gray or RGB, not interlaced. The whole image is
// inflated in one call (libdeflate), which takes a third of the work of libpng's row by row.
#include <opencv2/core/mat.hpp>
#include <string_view>

namespace edgevo {

/// Decodes an intact plain PNG to CV_8UC1 or, in OpenCV's order of channels, CV_8UC3: the same pixels as
/// cv::imdecode(). An empty image for every other file, also for damaged ones: all checksums are verified.
/// Another decoder then knows the format, or the reason.
cv::Mat decode_plain_png(std::string_view bytes);

}  // namespace edgevo
