#pragma once
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "assumed_camera.h"
#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// A video file, by OpenCV. Throws InputError if it does not open as one.
std::unique_ptr<ImageSource> open_video(const SourceOptions& options);

/// "camera:N", by OpenCV, which is asked for images of the calibration's size; the time is when an image came
/// in. It has no end: next() throws InputError when no image comes any more.
std::unique_ptr<ImageSource> open_live_camera(const SourceOptions& options);

/// Waits for the next image; false: there is none.
using GrabImage = std::function<bool(cv::Mat*)>;
/// What open_live_camera() plays, from any grabber.
std::unique_ptr<ImageSource> play_live(const SourceOptions& options, const Camera& camera, GrabImage grab,
                                       const Details& details = {});

}  // namespace edgevo
