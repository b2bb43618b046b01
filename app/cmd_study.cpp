// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/study/study_report.h"
#include "option_checks.h"
#include "progress.h"

namespace edgevo::app {
namespace {

struct StudyCommand {
  std::string out, scene = "street", frames;
  SourceOptions source;
  StudyOptions options;
  bool force = false;
};

void set_frames(const std::string& text, StudyOptions* options) {
  if (text.empty()) return;
  SourceOptions range;
  set_frame_range(text, &range);
  options->begin = range.first;
  options->end = range.last.value_or(-1);
}

int study(StudyCommand command) {
  set_frames(command.frames, &command.options);
  check_apart(command.source.path, command.out);
  check_folder_is_ours(command.out, {"study.md"}, command.force);
  const auto frames =
      command.source.path.empty() ? rendered_frames(command.scene) : virtual_kitti_frames(command.source);
  check_study(*frames, command.options);
  make_output_folder(command.out);
  command.options.threads = int(std::max(1u, std::thread::hardware_concurrency()));
  StudyResult result;
  {
    Progress progress("studying pairs", command.options.pairs);
    result = run_study(*frames, command.options, [&](int done) { progress.update(done); });
  }
  write_study(result, command.out);
  if (draw_plots(command.out))
    std::printf("%s: tables, plots and study.md\n", command.out.c_str());
  else
    std::printf(
        "%s: tables and study.md; for plots install gnuplot-nox and run `gnuplot plots.gnuplot` there\n",
        command.out.c_str());
  return 0;
}

}  // namespace

void add_study_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "study", "measure data association against exact depth and pose (the paper's section V-A)");
  auto c = std::make_shared<StudyCommand>();
  command->add_option("-o,--out", c->out, "folder to write")->required()->check(path_given());
  command->add_option("--scene", c->scene, "rendered scene: a name as for `edgevo simulate`, or a YAML file")
      ->capture_default_str();
  command->add_option("--source", c->source.path,
                      "Virtual KITTI sequence (1.3.1 or 2.0.3) to use instead of a rendered scene");
  command->add_option("--sensor", c->source.sensor_label,
                      "camera of the sequence, Camera_0 or Camera_1 (2.0.3)");
  command->add_option("--frames", c->frames, "use frames A to B-1, as A:B");
  command->add_option("--pairs", c->options.pairs, "number of host frames, spread evenly")
      ->check(whole_number(1, 100000))
      ->capture_default_str();
  command->add_option("--points", c->options.points, "number of edge points in each host frame")
      ->check(whole_number(20, 100000))
      ->capture_default_str();
  command->add_option("--noise", c->options.noise, "relative standard deviation of the inverse depth")
      ->check(number_between(0, 0.5))
      ->capture_default_str();
  command
      ->add_option("--distance", c->options.distance,
                   "frames between host and target for search length and patch size")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  command->add_option("--max-distance", c->options.max_distance, "largest frame distance of the third curve")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  command->add_option("--light", c->options.light, "kind of lighting change, as for `edgevo relight`")
      ->capture_default_str();
  command->add_option("--seed", c->options.seed, "seed of points, noise and light")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()))
      ->capture_default_str();
  add_force(*command, &c->force);
  command->callback([=] { *action = [=] { return study(*c); }; });
}

}  // namespace edgevo::app
