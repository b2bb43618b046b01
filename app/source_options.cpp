// SPDX-License-Identifier: BSD-3-Clause
#include "source_options.h"

#include <cstdio>

#include "edgevo/datasets/source_folder.h"
#include "option_checks.h"

namespace edgevo::app {

void add_source_options(CLI::App& command, SourceOptions* options) {
  command
      .add_option_function<std::string>(
          "SOURCE", [options](const std::string& path) { options->path = source_folder(path); },
          ".rawlog, data set folder (edgevo, KITTI, TUM RGB-D, EuRoC, Symphony Lake), folder of images, "
          "video, or camera:N")
      ->required();
  CLI::Option* camera =
      command.add_option("--camera", options->camera_file,
                         "calibration: `fx fy cx cy k1 k2 p1 p2 width height [k3]` or ROS/OpenCV YAML");
  command
      .add_option("--fov", options->fov_deg,
                  "horizontal field of view in degrees, instead of a calibration; assumes a lens without "
                  "distortion")
      ->check(number_between(1, 179))
      ->excludes(camera);
  command.add_option("--sensor", options->sensor_label, "camera to use, if the source has several");
  command.add_option_function<std::string>(
      "--frames", [options](const std::string& text) { set_frame_range(text, options); },
      "use only frames A to B-1, as A:B");
  command.add_option("--every", options->every, "use only every N-th of these frames")
      ->check(whole_number(1));
  command.add_option("--fps", options->fps, "frame rate of images or videos without timestamps")
      ->check(positive_number());
}

void add_image_scale(CLI::App& command, SourceOptions* options) {
  options->image_scale = 0;
  command
      .add_option("--image-scale", options->image_scale,
                  "scale the images by 0.01 to 1 (default: 1; images wider than 2482 px to a width of 1241)")
      ->check(number_between(0.01, 1));
}

std::vector<std::pair<std::string, std::string>> source_notices(const ImageSource& source) {
  std::vector<std::pair<std::string, std::string>> notices;
  for (const auto& detail : source.details())
    if (detail.first == kAssumed || detail.first == kScaled) notices.push_back(detail);
  return notices;
}

std::unique_ptr<ImageSource> open_source_with_notices(const SourceOptions& options) {
  auto source = open_source(options);
  for (const auto& [name, value] : source_notices(*source))
    std::fprintf(stderr, "edgevo: %s: %s %s\n", options.path.c_str(), name.c_str(), value.c_str());
  return source;
}

}  // namespace edgevo::app
