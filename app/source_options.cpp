// SPDX-License-Identifier: BSD-3-Clause
#include "source_options.h"

#include <charconv>
#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/datasets/describe.h"
#include "edgevo/datasets/scaled_source.h"
#include "edgevo/datasets/source_folder.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

// "WxH", both from 64, below which edges are too few, to 8192 pixels.
void parse_size(const std::string& text, TargetRequest* request) {
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, request->width);
  const char* const rest = width.ptr + (width.ptr != end && *width.ptr == 'x');
  const auto height = std::from_chars(rest, end, request->height);
  const auto is_side = [](int side) { return side >= 64 && side <= 8192; };
  if (width.ec != std::errc() || height.ec != std::errc() || rest == width.ptr || height.ptr != end ||
      !is_side(request->width) || !is_side(request->height))
    throw InputError("--rectify-size " + text, "is not WIDTHxHEIGHT with sides from 64 to 8192 pixels",
                     "write for example --rectify-size 640x480");
}

double parse_image_scale(const std::string& text) {
  if (text == "auto") return kAutomaticScale;
  double scale = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), scale);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !(scale >= 0.01 && scale <= 1))
    throw InputError("--image-scale " + text, "is neither auto nor a number from 0.01 to 1",
                     "write for example --image-scale 0.5");
  return scale;
}

}  // namespace

void add_source_options(CLI::App& command, SourceOptions* options) {
  command
      .add_option_function<std::string>(
          "SOURCE", [options](const std::string& path) { options->path = source_folder(path); },
          ".rawlog, ROS bag (.bag, .mcap, .db3 or its folder), data set folder (edgevo, KITTI, TUM RGB-D, "
          "EuRoC, Symphony Lake), folder of images, "
          "video, or camera:N")
      ->required();
  CLI::Option* camera = command.add_option(
      "--camera", options->camera_file,
      "calibration: 'fx fy cx cy k1 k2 p1 p2 width height [k3]', or a file of these numbers, of ROS, "
      "OpenCV, Kalibr, ORB-SLAM, Basalt, COLMAP (or its folder), DSO, MRPT, ViSP; `run` also takes auto: "
      "found from the motion");
  command
      .add_option("--camera-scale", options->camera_scale,
                  "size of the images over that of the calibration, if they were scaled (default: from both)")
      ->check(number_between(0.01, 100));
  command
      .add_option("--fov", options->fov_deg,
                  "field of view in degrees over the longer side of the images, instead of a calibration; "
                  "assumes a lens without distortion")
      ->check(number_between(1, 179))
      ->excludes(camera);
  command
      .add_option("--gyro", options->gyro,
                  "samples of a gyro next to the camera: FILE (EuRoC's data.csv, DM-VIO's imu.txt), or off "
                  "(default: that of the source, or next to it)")
      ->check(path_given());
  command.add_option("--sensor", options->sensor_label,
                     "camera to use, if the source or --camera has several");
  command.add_option("--topic", options->topic, "images of a ROS bag to use, if several topics have some");
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
  options->image_scale = kAutomaticScale;
  command.add_option_function<std::string>(
      "--image-scale", [options](const std::string& text) { options->image_scale = parse_image_scale(text); },
      "scale the images by 0.01 to 1, or auto (default): those of more than 720,000 pixels to 480,000");
}

void add_rectification(CLI::App& command, TargetRequest* request) {
  command
      .add_option(
          "--rectify-fov", request->view_deg,
          "degrees from side to side of the pinhole images that the method works in, at most (default: "
          "those of the camera file; 120 for a fisheye or another wide lens)")
      ->check(number_between(10, 150));
  command.add_option_function<std::string>(
      "--rectify-size", [request](const std::string& text) { parse_size(text, request); },
      "their size, WIDTHxHEIGHT (default: as sharp in the middle as the lens)");
}

void print_lines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::fprintf(stderr, "%s\n", line.c_str());
}

void print_decisions(const std::string& path, const std::vector<InputDecision>& decisions) {
  print_lines(decision_lines(path, decisions));
}

std::unique_ptr<ImageSource> open_source_with_notices(const SourceOptions& options) {
  auto source = open_source(options);
  print_lines(opening_lines(options.path, *source));
  return source;
}

}  // namespace edgevo::app
