#include "source_options.h"

#include "option_checks.h"

namespace edgevo::app {

void add_source_options(CLI::App& command, SourceOptions* options) {
  command
      .add_option("SOURCE", options->path,
                  "a .rawlog, a dataset folder (edgevo, KITTI, TUM RGB-D, EuRoC), a folder of images, a "
                  "video, or camera:N")
      ->required();
  command.add_option("--camera", options->camera_file,
                     "calibration: `fx fy cx cy k1 k2 p1 p2 width height [k3]` or ROS/OpenCV YAML");
  command.add_option("--sensor", options->sensor_label, "which camera, where the source has several");
  command.add_option_function<std::string>(
      "--frames", [options](const std::string& text) { set_frame_range(text, options); },
      "only frames A to B-1, as A:B");
  command.add_option("--every", options->every, "of these only each N-th")->check(whole_number(1));
  command.add_option("--fps", options->fps, "frames a second, for images or videos without times")
      ->check(positive_number());
}

}  // namespace edgevo::app
