// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/sequence_output/rendered_sequence.h"

#include <algorithm>
#include <memory>
#include <thread>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/wrapped_source.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"
#include "edgevo/sequence_output/rawlog_output.h"
#include "edgevo/simulation/correspondence_export.h"
#include "edgevo/simulation/folder_export.h"
#include "edgevo/simulation/rendered_source.h"
#include "edgevo/simulation/scene.h"
#include "edgevo/simulation/simulated_gyro.h"
#include "edgevo/simulation/survey_export.h"
#include "edgevo/simulation/traffic.h"

namespace edgevo {
namespace {

Scene scene_from(const RenderRequest& options) {
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

SimulatedGyro gyro_of(const SceneRenderer& renderer, const RenderRequest& options,
                      const FolderExport& range) {
  constexpr double kBeyondS = 0.5;  // both ends
  const std::vector<Timestamp>& times = renderer.scene().times;
  const size_t end = range.end < 0 ? times.size() : size_t(range.end);
  const double first = times[size_t(range.begin)].seconds();
  SimulatedGyro gyro =
      simulate_gyro(renderer.scene().T_scene_cam_at, first - kBeyondS, times[end - 1].seconds() + kBeyondS,
                    options.gyro, renderer.scene().seed);
  gyro.up = renderer.scene().T_scene_cam_at(first).rotation().conjugate() * Eigen::Vector3d::UnitZ();
  return gyro;
}

// imu.txt next to the images, and the truth about it.
void write_gyro(const SceneRenderer& renderer, const RenderRequest& options, const FolderExport& range) {
  const SimulatedGyro gyro = gyro_of(renderer, options, range);
  write_file(options.out + "/imu.txt", imu_text(gyro.samples));
  write_file(options.out + "/gyro_truth.yaml", gyro_truth_text(gyro, options.gyro));
}

// Rendered images with a simulated gyro.
class RenderedWithGyro : public WrappedSource {
 public:
  RenderedWithGyro(std::unique_ptr<RenderedSource> images, SimulatedGyro gyro)
      : WrappedSource(std::move(images)), gyro_(std::make_shared<const SimulatedGyro>(std::move(gyro))) {}

  GyroReadings gyro_readings() const override {
    return [gyro = gyro_, next = size_t(0)]() mutable -> std::optional<GyroSample> {
      return next < gyro->samples.size() ? std::make_optional(gyro->samples[next++]) : std::nullopt;
    };
  }

 private:
  std::shared_ptr<const SimulatedGyro> gyro_;
};

void write_rendered_folder(const SceneRenderer& renderer, const RenderRequest& options, FolderExport range,
                           const ShowFramesDone& progress) {
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
  export_folder(renderer, options.out, range, progress);
  if (!options.gyro.empty()) write_gyro(renderer, options, range);
}

std::string write_rendered_rawlog(const std::shared_ptr<const SceneRenderer>& renderer,
                                  const RenderRequest& options, const FolderExport& range,
                                  const ShowFramesDone& progress) {
  if (options.depth)
    throw InputError(options.out, "a rawlog does not hold depth", "name a folder, or omit --depth");
  if (options.edges)
    throw InputError(options.out, "a rawlog does not hold true edges", "name a folder, or omit --edges");
  std::unique_ptr<ImageSource> source = std::make_unique<RenderedSource>(renderer, range.begin, range.end);
  const std::string truth = ground_truth_tum(*renderer, range.begin, range.begin + *source->size());
  if (!options.gyro.empty()) {
    const SimulatedGyro gyro = gyro_of(*renderer, options, range);
    write_file(rawlog_stem(options.out) + "_gyro_truth.yaml", gyro_truth_text(gyro, options.gyro));
    source = std::make_unique<RenderedWithGyro>(
        std::make_unique<RenderedSource>(renderer, range.begin, range.end), gyro);
  }
  const int count = write_rawlog(*source, options.out, truth, progress);
  return describe_rawlog(options.out, count, true, source->camera());
}

void write_correspondences(const SceneRenderer& renderer, const std::string& folder, int begin, int end,
                           const ShowFramesDone& progress) {
  PyramidBuilder builder(renderer.camera(), EdgeParams());
  const auto find_edges = [&](const GrayImage& image) {
    std::vector<Eigen::Vector2d> found;
    const auto pyramid = builder.build(image);
    for (const EdgePixel& edge : pyramid->finest().edges.pixels)
      found.push_back(edge.position().cast<double>());
    return found;
  };
  export_correspondences(renderer, folder, begin, end, find_edges, progress);
}

bool has_foreign_bodies(const RenderRequest& options) {
  return !options.own_part.own_part.empty() || !options.traffic.empty();
}

// Adds a survey to the archive OUT.
void write_rendered_survey(const RenderRequest& options, const FolderExport& range,
                           const SequenceHost& host) {
  if (options.depth || options.correspondences)
    throw InputError(options.out, "a survey of Symphony Lake holds neither depth nor correspondences",
                     "omit --layout, or these");
  if (!options.gyro.empty())
    throw InputError(options.out, "a survey of Symphony Lake holds no gyro", "omit --layout, or --gyro");
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
    const ShowFramesDone progress = host.progress("rendering", end - range.begin);
    write_survey(renderer, survey, range.begin, end, progress);
  }
  host.print(survey.folder() + ": " + std::to_string(end - range.begin) + " frames, map in " +
             survey.map_folder());
}

}  // namespace

void write_rendered(const RenderRequest& options, const SequenceHost& host) {
  FolderExport range;
  range.begin = options.begin, range.end = options.end;
  if (options.layout != "edgevo") return write_rendered_survey(options, range, host);
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
    write_correspondences(*renderer, options.out, range.begin, range.begin + count,
                          host.progress("correspondences", count - 1));
  std::string done = options.out + ": " + std::to_string(count) + " frames with exact ground truth" +
                     (options.depth ? " and depth" : "");
  {
    const ShowFramesDone progress = host.progress("rendering", count);
    if (names_rawlog(options.out))
      done = write_rendered_rawlog(renderer, options, range, progress);
    else
      write_rendered_folder(*renderer, options, range, progress);
  }
  host.print(done);
}

}  // namespace edgevo
