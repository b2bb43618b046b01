// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Corners followed from one image into another (Lucas-Kanade of OpenCV), forwards and backwards.
#include <opencv2/core.hpp>
#include <vector>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Pixels of corners.
using Corners = std::vector<cv::Point2f>;

/// The finest image with equalised histogram, so that exposure does not matter.
cv::Mat equalised(const FramePyramid& pyramid);

/// Finds at most `count` corners, spread over the image, strongest first.
Corners find_corners(const cv::Mat& image, int count);

/// Drops corners on parts that are fixed to the camera.
void drop_own(const FramePyramid& pyramid, Corners* corners);

/// Drops corners that lie on a straight edge, where they are followed across it only: along it they stay
/// where the search begins, and confirm any motion. A corner is dropped if its standard deviation along the
/// weaker gradient of its patch is larger than `max_sigma_px`. Cost: some 10 us a corner.
void drop_on_edges(const cv::Mat& image, double max_sigma_px, Corners* corners);

/// Follows the corners `from` of one image into another. `to` holds where the search starts, or is empty: at
/// `from`. Returns one flag per corner: found in the image, and found again at its start when followed back.
std::vector<bool> follow_corners(const cv::Mat& image_from, const cv::Mat& image_to, const Corners& from,
                                 Corners* to);

/// Median motion in pixels of the `all` corners of a first view, of which the surviving ones moved from
/// `from` to `to` (one or more). Under noise and changing light fast corners are lost first: lost ones count
/// as moved further than the median, up to half as many as survive, or the median of the survivors would fall
/// with time (lab 2026-11-22_bootstrap).
double median_motion(size_t all, const Corners& from, const Corners& to);

}  // namespace edgevo
