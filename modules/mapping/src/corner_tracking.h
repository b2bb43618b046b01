#pragma once
// Corners followed from one image into another (Lucas and Kanade, as OpenCV has it), forwards and back.
#include <opencv2/core.hpp>
#include <vector>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

using Corners = std::vector<cv::Point2f>;

/// The finest image with its histogram made flat, so that exposure does not matter.
cv::Mat equalised(const FramePyramid& pyramid);

/// At most `count` corners, spread over the image, the strongest first.
Corners find_corners(const cv::Mat& image, int count);

/// Where the corners `from` of one image are in another. `to` holds where the search starts, or is empty:
/// where they were. Returns one flag a corner: found in the image, and found again where it began when
/// followed back.
std::vector<bool> follow_corners(const cv::Mat& image_from, const cv::Mat& image_to, const Corners& from,
                                 Corners* to);

/// Median motion, pixels, of the `all` corners of a first view, of which those left went from `from` to `to`
/// (one or more). Under noise and changing light those that move fast are lost first: the lost ones count as
/// moved further than the median, up to half as many as are left, or the median of what is left would fall
/// with time (share/lab/archive/2026-11-22_bootstrap.md).
double median_motion(size_t all, const Corners& from, const Corners& to);

}  // namespace edgevo
