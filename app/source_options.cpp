#include "source_options.h"

#include <cstdio>

#include "edgevo/datasets/source_folder.h"
#include "option_checks.h"

namespace edgevo::app {

void add_source_options(CLI::App& command, SourceOptions* options) {
  command
      .add_option_function<std::string>(
          "SOURCE", [options](const std::string& path) { options->path = source_folder(path); },
          "a .rawlog, a dataset folder (edgevo, KITTI, TUM RGB-D, EuRoC, Symphony Lake), a folder of images, "
          "a "
          "video, or camera:N")
      ->required();
  CLI::Option* camera =
      command.add_option("--camera", options->camera_file,
                         "calibration: `fx fy cx cy k1 k2 p1 p2 width height [k3]` or ROS/OpenCV YAML");
  command
      .add_option("--fov", options->fov_deg,
                  "instead of a calibration: the angle over the images' width, degrees; the lens is taken to "
                  "be free of "
                  "distortion")
      ->check(number_between(1, 179))
      ->excludes(camera);
  command.add_option("--sensor", options->sensor_label, "which camera, where the source has several");
  command.add_option_function<std::string>(
      "--frames", [options](const std::string& text) { set_frame_range(text, options); },
      "only frames A to B-1, as A:B");
  command.add_option("--every", options->every, "of these only each N-th")->check(whole_number(1));
  command.add_option("--fps", options->fps, "frames a second, for images or videos without times")
      ->check(positive_number());
}

void add_image_scale(CLI::App& command, SourceOptions* options) {
  options->image_scale = 0;
  command
      .add_option(
          "--image-scale", options->image_scale,
          "scale the images, 0.01 to 1 (default: 1; where they are wider than 2482 px, to a width of 1241)")
      ->check(number_between(0.01, 1));
}

std::vector<std::pair<std::string, std::string>> to_be_told(const ImageSource& source) {
  std::vector<std::pair<std::string, std::string>> told;
  for (const auto& detail : source.details())
    if (detail.first == kAssumed || detail.first == kScaled) told.push_back(detail);
  return told;
}

std::unique_ptr<ImageSource> open_and_tell(const SourceOptions& options) {
  auto source = open_source(options);
  for (const auto& [name, value] : to_be_told(*source))
    std::fprintf(stderr, "edgevo: %s: %s %s\n", options.path.c_str(), name.c_str(), value.c_str());
  return source;
}

}  // namespace edgevo::app
