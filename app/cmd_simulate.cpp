// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/results/rawlog_output.h"
#include "edgevo/simulation/correspondence_export.h"
#include "edgevo/simulation/folder_export.h"
#include "edgevo/simulation/rendered_source.h"
#include "edgevo/simulation/scene.h"
#include "edgevo/simulation/survey_export.h"
#include "edgevo/simulation/traffic.h"
#include "option_checks.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

constexpr const char* kSurveys = "symphony_lake";
constexpr const char* kNewSurveys = "symphony_lake_new";

struct SimulateOptions {
  std::string scene, out, camera_file, frames, season, survey, layout = "edgevo";
  std::optional<uint64_t> seed;
  std::optional<double> rolling_shutter_s, exposure_s;
  std::optional<CameraMount> mount;
  OverlayOptions own_part;
  std::vector<std::string> traffic;
  bool depth = false, edges = false, correspondences = false, force = false;
};

// "A:B", "A:" or ":B"; empty: all.
void set_range(const std::string& text, FolderExport* range) {
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

Scene scene_from(const SimulateOptions& options) {
  Scene scene =
      load_scene(options.season.empty() ? options.scene : options.scene + ":" + options.season, options.seed);
  scene.shutter.rolling_s = options.rolling_shutter_s.value_or(scene.shutter.rolling_s);
  scene.shutter.exposure_s = options.exposure_s.value_or(scene.shutter.exposure_s);
  if (!options.camera_file.empty()) {
    scene.camera = read_camera_file(options.camera_file);
    scene.has_given_camera = true;
  }
  for (const std::string& kind : options.traffic) add_traffic(kind, &scene);
  const std::optional<CameraMount> of_file =
      options.camera_file.empty() ? std::nullopt : read_camera_mount(options.camera_file);
  if (const auto mount = options.mount ? options.mount : of_file) mount_camera(*mount, &scene);
  return scene;
}

// Empty for a lens that the usual line of numbers can hold.
std::string camera_text_for(const Camera& camera) {
  return camera.plumb_bob() ? std::string() : camera_yaml(camera, "");
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void write_folder(const SceneRenderer& renderer, const SimulateOptions& options, FolderExport range,
                  Progress& progress) {
  range.depth = options.depth;
  range.edges = options.edges;
  range.camera_text = camera_text_for(renderer.camera());
  if (!options.own_part.own_part.empty()) {
    const Pinhole p = renderer.camera().pinhole();
    OverlayOptions part = options.own_part;
    part.seed = renderer.scene().seed;
    range.own_part = std::make_shared<const Overlay>(part, p.width, p.height);
  }
  range.threads = int(std::max(1u, std::thread::hardware_concurrency()));
  export_folder(renderer, options.out, range, [&](int done) { progress.update(done); });
}

std::string write_as_rawlog(const std::shared_ptr<const SceneRenderer>& renderer,
                            const SimulateOptions& options, const FolderExport& range, Progress& progress) {
  if (options.depth)
    throw InputError(options.out, "a rawlog does not hold depth", "name a folder, or omit --depth");
  if (options.edges)
    throw InputError(options.out, "a rawlog does not hold true edges", "name a folder, or omit --edges");
  RenderedSource source(renderer, range.begin, range.end);
  const int count = write_rawlog(source, options.out,
                                 ground_truth_tum(*renderer, range.begin, range.begin + *source.size()),
                                 [&](int done) { progress.update(done); });
  return describe_rawlog(options.out, count, true, source.camera());
}

void write_correspondences(const SceneRenderer& renderer, const std::string& folder, int begin, int end) {
  Progress progress("correspondences", end - begin - 1);
  PyramidBuilder builder(renderer.camera(), EdgeParams());
  const auto find_edges = [&](const GrayImage& image) {
    std::vector<Eigen::Vector2d> found;
    const auto pyramid = builder.build(image);
    for (const EdgePixel& edge : pyramid->finest().edges.pixels)
      found.push_back(edge.position().cast<double>());
    return found;
  };
  export_correspondences(renderer, folder, begin, end, find_edges, [&](int done) { progress.update(done); });
}

bool has_foreign_bodies(const SimulateOptions& options) {
  return !options.own_part.own_part.empty() || !options.traffic.empty();
}

// Adds a survey to the archive OUT.
int simulate_survey(const SimulateOptions& options, const FolderExport& range) {
  if (options.depth || options.correspondences)
    throw InputError(options.out, "a survey of Symphony Lake holds neither depth nor correspondences",
                     "omit --layout, or these");
  if (has_foreign_bodies(options))
    throw InputError(options.out, "masks do not fit into a survey of Symphony Lake",
                     "omit --layout, or --own-part and --traffic");
  if (options.mount)
    throw InputError(options.out, "a survey of Symphony Lake has a mount of its own",
                     "omit --layout, or --mount");
  const std::string name = options.survey.empty() ? usual_survey_name(options.season) : options.survey;
  const SurveyLocation survey{options.out, name, options.layout == kNewSurveys};
  check_folder_is_ours(survey.folder(), {"SOURCE.md"}, options.force);
  const SceneRenderer renderer(scene_from(options));
  const int end = range.end < 0 ? renderer.size() : range.end;
  {
    Progress progress("rendering", end - range.begin);
    write_survey(renderer, survey, range.begin, end, [&](int done) { progress.update(done); });
  }
  std::printf("%s: %d frames, map in %s\n", survey.folder().c_str(), end - range.begin,
              survey.map_folder().c_str());
  return 0;
}

int simulate(const SimulateOptions& options) {
  FolderExport range;
  set_range(options.frames, &range);
  if (options.layout != "edgevo") return simulate_survey(options, range);
  if (has_foreign_bodies(options) && names_rawlog(options.out))
    throw InputError(options.out, "masks do not fit into a rawlog", "name a folder");
  if (options.correspondences && names_rawlog(options.out))
    throw InputError(options.out, "a rawlog does not hold correspondences",
                     "name a folder, or omit --correspondences");
  check_sequence_output("", options.out, options.force);
  const auto renderer = std::make_shared<const SceneRenderer>(scene_from(options));
  const int count = (range.end < 0 ? renderer->size() : range.end) - range.begin;
  if (!names_rawlog(options.out)) clear_sequence(options.out);
  if (options.correspondences)
    write_correspondences(*renderer, options.out, range.begin, range.begin + count);
  std::string done = options.out + ": " + std::to_string(count) + " frames with exact ground truth" +
                     (options.depth ? " and depth" : "");
  {
    Progress progress("rendering", count);
    if (names_rawlog(options.out))
      done = write_as_rawlog(renderer, options, range, progress);
    else
      write_folder(*renderer, options, range, progress);
  }
  std::printf("%s\n", done.c_str());
  return 0;
}

}  // namespace

void add_simulate_command(CLI::App& app, Action* action) {
  CLI::App* command =
      app.add_subcommand("simulate", "render a scene with exact ground truth, as a folder or a rawlog");
  auto options = std::make_shared<SimulateOptions>();
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
  command->add_option("--frames", options->frames, "render frames A to B-1, as A:B");
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
  command->callback([=] { *action = [=] { return simulate(*options); }; });
}

}  // namespace edgevo::app
