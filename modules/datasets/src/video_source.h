// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// Opens a video file with OpenCV. Throws InputError if it does not open as one.
std::unique_ptr<ImageSource> open_video(const SourceOptions& options);

/// Opens "camera:N" with OpenCV, requesting images of the calibration's size; the time of an image is its
/// time of arrival. The source has no end: next() throws InputError when images stop arriving.
std::unique_ptr<ImageSource> open_live_camera(const SourceOptions& options);

/// Waits for the next image; returns false if there is none.
using GrabImage = std::function<bool(cv::Mat*)>;
/// The source behind open_live_camera(), from any grabber.
std::unique_ptr<ImageSource> play_live(const SourceOptions& options, const Camera& camera, GrabImage grab,
                                       const std::vector<InputDecision>& decisions = {});

}  // namespace edgevo
