// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <optional>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/sequence_output/rendered_sequence.h"
#include "edgevo/simulation/scene.h"
#include "edgevo/simulation/simulated_gyro.h"
#include "edgevo/simulation/traffic.h"
#include "option_checks.h"
#include "sequence_host.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

struct SimulateArguments {
  RenderRequest request;
  std::string frames;
};

// "A:B", "A:" or ":B"; empty: all.
void set_range(const std::string& text, RenderRequest* range) {
  if (text.empty()) return;
  const size_t colon = text.find(':');
  const auto number = [&](const std::string& digits, int otherwise) {
    if (digits.empty()) return otherwise;
    if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 9)
      throw InputError("--frames " + text, "is not A:B with whole numbers",
                       "write for example --frames 0:100");
    return std::stoi(digits);
  };
  if (colon == std::string::npos)
    throw InputError("--frames " + text, "has no colon", "write for example --frames 0:100");
  range->begin = number(text.substr(0, colon), 0);
  range->end = number(text.substr(colon + 1), -1);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

int simulate(const SimulateArguments& args) {
  RenderRequest request = args.request;
  set_range(args.frames, &request);
  write_rendered(request, sequence_host());
  return 0;
}

}  // namespace

void add_simulate_command(CLI::App& app, Action* action) {
  CLI::App* command =
      app.add_subcommand("simulate", "render a scene with exact ground truth, as a folder or a rawlog");
  auto args = std::make_shared<SimulateArguments>();
  RenderRequest* const options = &args->request;
  std::string known;
  for (const std::string& name : scene_names()) known += (known.empty() ? "" : ", ") + name;
  command->add_option("SCENE", options->scene, "name or YAML file of a scene; names: " + known)->required();
  command->add_option("-o,--out", options->out, "folder or OUT.rawlog to write")
      ->required()
      ->check(path_given());
  command->add_option("--seed", options->seed, "seed of world and motion (default: that of the scene)")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()));
  command->add_option(
      "--camera", options->camera_file,
      "camera file of another lens or size, up to a whole sphere (default: that of the scene)");
  command->add_option("--frames", args->frames, "render frames A to B-1, as A:B");
  command->add_option(
      "--season", options->season,
      "season of lakeshore (leaves and light): spring, summer, autumn or winter; also as SCENE:SEASON");
  command
      ->add_option(
          "--layout", options->layout,
          "layout of the output: edgevo (default), or a survey in the archive OUT as symphony_lake or "
          "symphony_lake_new (newer names)")
      ->check(CLI::IsMember({"edgevo", kSurveys, kNewSurveys}));
  command->add_option("--survey", options->survey,
                      "name of the survey, YYMMDD (default: a day in the season)");
  command
      ->add_option("--rolling-shutter", options->rolling_shutter_s,
                   "read-out time from the first image row to the last, seconds (default: that of the scene, "
                   "usually 0)")
      ->check(number_from_zero());
  command
      ->add_option("--exposure", options->exposure_s,
                   "exposure time, seconds, which blurs along the true motion (default: that of the scene, "
                   "usually 0)")
      ->check(number_from_zero());
  command
      ->add_option("--gyro", options->gyro,
                   "samples of a gyro next to the camera, with its errors, as imu.txt and gyro_truth.yaml: " +
                       listed(gyro_kinds()))
      ->check(CLI::IsMember(gyro_kinds()));
  add_mount(*command, &options->mount);
  CLI::Option* own_part =
      command->add_option("--own-part", options->own_part.own_part,
                          "part that is fixed to the camera, with mask.png: " + listed(own_part_kinds()));
  command
      ->add_option("--part-share", options->own_part.part_share,
                   "its share of the image (default: 0.1; bow 0.15, bonnet 0.2, dashboard 0.3)")
      ->check(number_between(0.01, 0.5))
      ->needs(own_part);
  command
      ->add_option(
          "--traffic", options->traffic,
          "what moves by itself along the camera's path, with masks/ (255, or the number of the body); "
          "may be given again: " +
              listed(traffic_kinds()))
      ->allow_extra_args(false);
  command->add_flag("--depth", options->depth, "also write exact depth images (PFM)");
  command->add_flag("--edges", options->edges,
                    "also write the true edges and their kinds (edges/*.png: depth steps 255, creases 170, "
                    "texture 85)");
  command->add_flag("--correspondences", options->correspondences,
                    "also write the position of each edge pixel in the next frame (correspondences/*.csv)");
  add_force(*command, &options->force);
  command->callback([=] { *action = [=] { return simulate(*args); }; });
}

}  // namespace edgevo::app
