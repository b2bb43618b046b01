// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/results/rawlog_output.h"
#include "edgevo/simulation/folder_export.h"
#include "edgevo/simulation/relit_source.h"
#include "option_checks.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

struct RelightOptions {
  SourceOptions source;
  std::string out, kind = "mixed";
  uint64_t seed = 1;
  bool force = false;
};

int write_folder(RelitSource& source, const RelightOptions& options, const std::string& truth,
                 Progress& progress) {
  clear_sequence(options.out);
  const Camera& camera = source.camera();
  FolderWriter writer(options.out, camera, camera.plumb_bob() ? "" : camera_yaml(camera, ""));
  int count = 0;
  while (const std::optional<Frame> frame = source.next()) {
    writer.add(*frame);
    progress.update(++count);
  }
  writer.finish(
      truth,
      "# Relit sequence\n\nThe images of another sequence under changed light (`edgevo relight --kind " +
          options.kind + " --seed " + std::to_string(options.seed) +
          "`); names, times, calibration and ground truth are the source's. Its licence holds for these "
          "images, too.\n");
  return count;
}

int relight(const RelightOptions& options) {
  check_sequence_output(options.source.path, options.out, options.force);
  const Relight effect(options.kind, options.seed);
  auto opened = open_source_with_notices(options.source);
  const std::string truth = ground_truth_tum(options.source, *opened);
  RelitSource source(std::move(opened), effect);
  int count = 0;
  {
    Progress progress("relighting", source.size());
    const auto on_frame_done = [&](int done) { progress.update(done); };
    count = names_rawlog(options.out) ? write_rawlog(source, options.out, truth, on_frame_done)
                                      : write_folder(source, options, truth, progress);
  }
  std::printf("%s: %d frames, %s\n", options.out.c_str(), count, options.kind.c_str());
  return 0;
}

}  // namespace

void add_relight_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "relight", "write a copy of a source under changed lighting, as a folder or a rawlog");
  auto options = std::make_shared<RelightOptions>();
  add_source_options(*command, &options->source);
  std::string kinds;
  for (const std::string& kind : relight_kinds()) kinds += (kinds.empty() ? "" : ", ") + kind;
  command->add_option("-o,--out", options->out, "folder or OUT.rawlog to write")
      ->required()
      ->check(path_given());
  command->add_option("--kind", options->kind, "kind of lighting change: " + kinds)->capture_default_str();
  command->add_option("--seed", options->seed, "seed of the lighting changes")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()))
      ->capture_default_str();
  add_force(*command, &options->force);
  command->callback([=] { *action = [=] { return relight(*options); }; });
}

}  // namespace edgevo::app
