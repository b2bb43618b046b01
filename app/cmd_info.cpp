// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/describe.h"
#include "edgevo/kept_map/kept_map.h"
#include "edgevo/kept_map/map_picture.h"
#include "option_checks.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

void print(const std::string& name, const std::string& value) {
  std::printf("%-18s %s\n", name.c_str(), value.c_str());
}

void check_every_frame(const std::string& path, ImageSource& source) {
  constexpr size_t kMaxShown = 10;
  int frames = 0;
  std::vector<std::string> bad;
  {
    Progress progress("checking", source.size());
    bad = find_bad_frames(
        source, [&](int done) { progress.update(done); }, &frames);
  }
  if (bad.empty())
    return print("check", "all " + std::to_string(frames) + " images decode, sizes and times are right");
  for (size_t i = 0; i < std::min(kMaxShown, bad.size()); ++i) print("BAD", bad[i]);
  throw InputError(path,
                   std::to_string(bad.size()) + " of " + std::to_string(frames) +
                       " frames cannot be used; the first: " + bad.front(),
                   "a run skips them");
}

int info_of_camera(const std::string& path, const std::string& sensor) {
  const Camera camera = read_camera_file(path, sensor);
  camera.check(path);
  print("camera file", path);
  for (const auto& [name, value] : describe(camera)) print(name, value);
  return 0;
}

int info_of_map(const std::string& path, const std::string& picture) {
  const KeptMap map = read_map(path);
  print("map", path);
  for (const auto& [name, value] : describe(map, path)) print(name, value);
  std::fflush(stdout);
  for (const std::string& line : map.warnings) std::fprintf(stderr, "edgevo: %s\n", line.c_str());
  if (!picture.empty()) write_file(picture, map_picture(map));
  return 0;
}

void check_no_picture(const std::string& picture) {
  if (!picture.empty()) throw InputError("-o " + picture, "only a map has a picture", "give map.db of a run");
}

// The contents are shown without a calibration, too.
int info(SourceOptions options, bool check, const std::string& picture) {
  if (names_map(options.path)) return info_of_map(options.path, picture);
  check_no_picture(picture);
  if (names_camera_file(options.path)) return info_of_camera(options.path, options.sensor_label);
  options.any_camera = true;
  const auto source = open_source(options);
  print("source", options.path);
  for (const auto& [name, value] : describe(*source)) print(name, value);
  std::fflush(stdout);
  if (check) check_every_frame(options.path, *source);
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand("info",
                                         "show the contents of a source (frames, camera, times, labels), of "
                                         "a camera file or of the map of a run");
  auto options = std::make_shared<SourceOptions>();
  auto check = std::make_shared<bool>(false);
  add_source_options(*command, options.get());
  add_mount(*command, &options->mount);
  command->add_flag("--check", *check, "also read every image");
  auto picture = std::make_shared<std::string>();
  command->add_option("-o,--out", *picture, "PNG for the map from above: points, path, places seen again")
      ->check(path_given());
  command->callback([=] { *action = [=] { return info(*options, *check, *picture); }; });
}

}  // namespace edgevo::app
