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
                         "calibration: `fx fy cx cy k1 k2 p1 p2 width height [k3]`, YAML of ROS, OpenCV or "
                         "Kalibr, ost.txt, a 3x3 matrix");
  command
      .add_option("--fov", options->fov_deg,
                  "field of view in degrees over the longer side of the images, instead of a calibration; "
                  "assumes a lens without distortion")
      ->check(number_between(1, 179))
      ->excludes(camera);
  command.add_option("--sensor", options->sensor_label, "camera to use, if the source has several");
  command.add_option_function<std::string>(
      "--frames", [options](const std::string& text) { set_frame_range(text, options); },
      "use only frames A to B-1, as A:B");
  command.add_option("--every", options->every, "use only every N-th of these frames")
      ->check(whole_number(1));
  command.add_option("--images", options->images,
                     "names of the images of a folder to use, as 'left_#.png': # is a number, * any text");
  command
      .add_option("--bits", options->bits, "significant bits of images of more than 8 (default: from them)")
      ->check(whole_number(8, 16));
  command
      .add_option("--time-unit", options->time_unit,
                  "unit of the times in a list or in names of images (default: from them)")
      ->check(CLI::IsMember({"s", "ms", "us", "ns"}));
  command.add_option("--fps", options->fps, "frame rate of images or videos without timestamps")
      ->check(positive_number());
}

void add_mount(CLI::App& command, std::optional<CameraMount>* mount) {
  command.add_option_function<std::string>(
      "--mount", [mount](const std::string& text) { *mount = parse_camera_mount(text, "--mount " + text); },
      "mount of the camera on its vehicle: roll,pitch,yaw in degrees or roll,pitch,yaw,x,y,z with metres; "
      "vehicle x forward, y left, z up; positive pitch looks down, yaw left, roll turns clockwise: 0,20,0 is "
      "20 degrees down");
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
    if (detail.first == kScaled) notices.push_back(detail);
  return notices;
}

std::unique_ptr<ImageSource> open_source_with_notices(const SourceOptions& options, bool quiet) {
  auto source = open_source(options);
  if (quiet) return source;
  for (const auto& [name, value] : source_notices(*source))
    std::fprintf(stderr, "edgevo: %s: %s %s\n", options.path.c_str(), name.c_str(), value.c_str());
  for (const InputDecision& decision : source->decisions())
    std::fprintf(stderr, "edgevo: %s: %s\n", options.path.c_str(), to_string(decision).c_str());
  for (const std::string& warning : input_warnings(source->decisions()))
    std::fprintf(stderr, "WARNING: %s\n", warning.c_str());
  return source;
}

}  // namespace edgevo::app
