#pragma once
#include <memory>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// A video file, by OpenCV. Throws InputError if it does not open as one.
std::unique_ptr<ImageSource> open_video(const SourceOptions& options);

/// "camera:N", by OpenCV; the time is when the image came in.
std::unique_ptr<ImageSource> open_live_camera(const SourceOptions& options);

}  // namespace edgevo
