// SPDX-License-Identifier: BSD-3-Clause
#include "run_contents.h"

#include <filesystem>
#include <variant>

#include "edgevo/core/error.h"
#include "edgevo/core/params.h"
#include "edgevo/core/rectification.h"
#include "edgevo/core/target_pinhole.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/frame_evaluation/reported_frame.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "edgevo/results/run_outputs.h"

namespace edgevo::python {
namespace {

void replay(const RunContents& contents, const std::shared_ptr<MapLog>& log, RunOutputs* outputs) {
  for (const RecordedFrame& f : contents.frames) {
    for (const auto& event : f.events) log->append(*event);
    // Of an image that has a file, the pixels are not needed.
    Frame frame{f.record.index, f.record.time, {}, {}};
    if (!f.image_path.empty()) frame.image = {1, 1, {0}};
    if (!outputs->add_frame(frame, f.image_path)) return;  // finish() throws the reason
    outputs->add_record(f.record);
  }
  for (const auto& event : contents.events_at_end) log->append(*event);
}

void add_frames(const std::string& folder, Run* run) {
  const auto live = read_reported_frames(folder, PoseSource::kLive);
  const auto final = read_reported_frames(folder, PoseSource::kFinal);
  for (size_t i = 0; i < final.size(); ++i) {
    FrameRecord& frame = run->frames.emplace_back();
    frame.index = final[i].index, frame.time = final[i].time, frame.state = final[i].state;
    frame.segment = final[i].segment, frame.p_right = final[i].p_right;
    frame.covariance = final[i].covariance;
    frame.T_world_cam = final[i].T_world_cam, frame.T_world_cam_live = live[i].T_world_cam;
  }
}

}  // namespace

void RunRecorder::add(const FrameRecord& record, const std::string& image_path) {
  RecordedFrame& frame = frames_.emplace_back();
  frame.record = record, frame.image_path = image_path;
  for (const auto& event : events_.read())
    if (!std::holds_alternative<WindowAdjusted>(*event)) frame.events.push_back(event);
}

OdometryOptions odometry_options(const Camera& camera, uint64_t seed) {
  OdometryOptions options;
  options.seed = seed;
  options.detectors = all_edge_detectors();
  options.map_log = std::make_shared<MapLog>();
  if (!camera.plumb_bob()) options.working_pinhole = target_pinhole(camera);
  return options;
}

KeptPlaces read_map_for(const std::string& path, const Camera& camera, const OdometryOptions& options,
                        const std::string& scale) {
  return {path, rectification_of(camera, options).target(), scale};
}

void finish_in_map(const KeptPlaces& map, Run* run, const std::function<void(const std::string&)>& say) {
  map.give_unit(run);
  say(map.statement(*run));
}

RunInfo describe_run(const Camera& camera, const RunParams& given, const OdometryOptions& options) {
  RunParams params = given;
  RunInfo info;
  info.command_line = {"import edgevo"};
  info.source_kind = "Python";
  info.camera = camera;
  info.working_pinhole = options.working_pinhole;
  if (options.working_pinhole) info.input.push_back(describe_target(camera, *options.working_pinhole));
  info.params_yaml = write_params([&](ParamVisitor& v) { params.visit(v); });
  info.notes = {{"seed", std::to_string(options.seed)},
                {"mode", options.realtime ? "realtime, two threads" : "synchronous"}};
  return info;
}

void write_run(const RunContents& contents, const std::string& folder) {
  if (!contents.folder.empty())
    throw InputError(folder, "the run was read from " + contents.folder, "its files are there");
  OutputOptions options;
  if (!contents.frames.empty()) options.mcap = McapContent::kPoses;
  options.keep_map = !contents.keyframes.empty();
  RunOutputs outputs(folder, contents.camera, contents.map, options);
  const auto log = std::make_shared<MapLog>();
  if (!contents.frames.empty())
    outputs.keep_recovery_log({contents.info, contents.scale, contents.tracks, contents.run.T_vehicle_cam},
                              log);
  replay(contents, log, &outputs);
  for (const auto& [id, keyframe] : contents.keyframes) outputs.add_keyframe(keyframe);
  outputs.finish(contents.run, contents.info);
}

RunContents read_run(const std::string& folder) {
  RunContents contents;
  contents.folder = folder;
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder, "is not a folder", "give the folder of a finished run");
  const std::string edges = (std::filesystem::path(folder) / "edges.ply").string();
  if (std::filesystem::exists(edges)) contents.run = read_edge_ply(edges);
  add_frames(folder, &contents.run);
  return contents;
}

}  // namespace edgevo::python
