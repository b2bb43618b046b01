// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/datasets/describe.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

void print(const std::string& name, const std::string& value) {
  std::printf("%-18s %s\n", name.c_str(), value.c_str());
}

void check_every_frame(ImageSource& source) {
  int count = 0;
  {
    Progress progress("checking", source.size());
    while (source.next()) progress.update(++count);
  }
  print("check", "all " + std::to_string(count) + " images decode, sizes and times are right");
}

// The contents are shown without a calibration, too.
int info(SourceOptions options, bool check) {
  options.any_camera = true;
  const auto source = open_source(options);
  print("source", options.path);
  for (const auto& [name, value] : describe(*source)) print(name, value);
  std::fflush(stdout);
  if (check) check_every_frame(*source);
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, Action* action) {
  CLI::App* command =
      app.add_subcommand("info", "show the contents of a source: frames, camera, times, labels");
  auto options = std::make_shared<SourceOptions>();
  auto check = std::make_shared<bool>(false);
  add_source_options(*command, options.get());
  add_mount(*command, &options->mount);
  command->add_flag("--check", *check, "also read every image");
  command->callback([=] { *action = [=] { return info(*options, *check); }; });
}

}  // namespace edgevo::app
