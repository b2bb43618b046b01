// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/recover_run.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/edge_map/repeated_lines.h"
#include "edgevo/map/run_builder.h"
#include "edgevo/results/recovery_log.h"
#include "edgevo/results/run_outputs.h"
#include "edgevo/results/run_params.h"
#include "edgevo/scale/run_scaling.h"
#include "edgevo/scale/up_direction.h"
#include "mcap_run.h"

namespace edgevo {
namespace {

RunParams params_of(const RunInfo& info, const std::optional<double>& resolution) {
  RunParams params;
  read_params(info.params_yaml, kRecoveryLog, [&](ParamVisitor& v) { params.visit(v); });
  if (resolution) params.map.occupancy.resolution = fixed(*resolution, 9);
  return params;
}

// Whether the run was left to be finished later, as its options say.
bool was_forgotten(const RunInfo& info) {
  return std::any_of(info.notes.begin(), info.notes.end(),
                     [](const auto& note) { return note.first == kForgottenNote; });
}

RunInfo info_of(RunInfo info, const Run& run) {
  if (was_forgotten(info)) return info;
  info.interrupted = true;
  info.notes.emplace_back("cut_off", "the program was killed after " + std::to_string(run.frames.size()) +
                                         " frames; `edgevo finish` wrote the results up to then");
  info.notes.emplace_back("timing_of", "`edgevo finish`, except for the stages");
  return info;
}

// Whether run.mcap is to be written anew: the events say all that it holds but images, with which it stays as
// the run has left it.
bool writes_mcap(const std::string& path, const RunInfo& info, const std::optional<McapContent>& content) {
  if (content) return *content != McapContent::kOff;
  std::error_code ignored;
  const std::pair<std::string, std::string> images{kMcapNote, kMcapWithImages};
  const bool has_images = std::find(info.notes.begin(), info.notes.end(), images) != info.notes.end();
  return !has_images && std::filesystem::exists(path, ignored);
}

// run.mcap, written anew.
struct RecoveredMcap {
  RecoveredMcap(const std::string& folder, const RecoveryHeader& header, const MapParams& map,
                const std::optional<McapContent>& content) {
    const std::string path = (std::filesystem::path(folder) / kMcapFile).string();
    if (!writes_mcap(path, header.info, content)) return;
    attempt([&] { output = std::make_unique<McapOutput>(path, mcap_run(header, map)); });
  }
  void apply(MapEvent event) {
    if (output) attempt([&] { output->apply({std::make_shared<const MapEvent>(std::move(event))}); });
  }
  void attempt(const std::function<void()>& work) {
    try {
      work();
    } catch (const InputError& e) {
      failure = e;
      output.reset();
    }
  }

  std::unique_ptr<McapOutput> output;
  std::optional<InputError> failure;
};

// Frames that the log holds but that were not recovered.
int frames_lost(const std::set<int>& beyond_damage, const Run& run) {
  const int last = run.frames.empty() ? -1 : run.frames.back().index;
  return int(std::distance(beyond_damage.upper_bound(last), beyond_damage.end()));
}

}  // namespace

RecoveredRun recover_run(const std::string& folder, const RecoveryOptions& options) {
  RecoveryLogReader log(folder);
  const RecoveryHeader& header = log.header();
  const RunParams params = params_of(header.info, options.resolution);
  const Rectification rectification = rectification_of(header.info.camera, header.info.working_pinhole);
  RunBuilder builder(rectification);
  RunScaling scaling(parse_scale_sources(header.scale), header.tracks, rectification.target(),
                     header.T_vehicle_cam, params.scale);
  RecoveredMcap mcap(folder, header, params.map, options.mcap);
  while (std::optional<MapEvent> event = log.next()) {
    builder.apply(*event);
    scaling.apply(*event);
    mcap.apply(std::move(*event));
  }
  builder.adopt_window();
  Run run = builder.finish();
  merge_repeated_lines(run.pinhole, params.odometry.edge_map, &run.keyframes);
  run.T_vehicle_cam = header.T_vehicle_cam;
  RunInfo info = info_of(header.info, run);
  if (const auto up = decide_up(&run)) info.input.push_back(*up);
  scaling.convert(&run);
  const std::set<int> beyond = log.frames_beyond_damage();
  RecoveredRun recovered{{}, frames_lost(beyond, run), !beyond.empty(), {}, {}};
  if (recovered.is_damaged)
    info.notes.emplace_back("recovery_log", "damaged: " + std::to_string(recovered.frames_lost) +
                                                " frames that it holds could not be recovered");
  OutputOptions output_options;
  output_options.force = true;
  output_options.include_doubtful = options.include_doubtful;
  RunOutputs outputs(folder, header.info.camera, params.map, output_options);
  outputs.adopt(run.frames.empty() ? -1 : run.frames.back().index);
  outputs.adopt(std::move(mcap.output), mcap.failure);
  outputs.adopt_map();
  outputs.finish(run, info, recovered.is_damaged);
  recovered.map_note = outputs.map_note();
  recovered.mcap_note = outputs.mcap_note();
  recovered.run = std::move(run);
  return recovered;
}

}  // namespace edgevo
