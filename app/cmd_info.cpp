// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/describe.h"
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

// The contents are shown without a calibration, too.
int info(SourceOptions options, bool check) {
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
  CLI::App* command = app.add_subcommand(
      "info", "show the contents of a source (frames, camera, times, labels) or of a camera file");
  auto options = std::make_shared<SourceOptions>();
  auto check = std::make_shared<bool>(false);
  add_source_options(*command, options.get());
  add_mount(*command, &options->mount);
  command->add_flag("--check", *check, "also read every image");
  command->callback([=] { *action = [=] { return info(*options, *check); }; });
}

}  // namespace edgevo::app
