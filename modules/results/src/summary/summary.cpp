// SPDX-License-Identifier: BSD-3-Clause
#include "summary.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "edgevo/core/output_file.h"
#include "edgevo/run_quality/guessed_places.h"
#include "edgevo/run_quality/run_statistics.h"
#include "edgevo/run_quality/run_warnings.h"
#include "edgevo/run_quality/scale_faults.h"
#include "edgevo_build_info.h"
#include "summary_parts.h"

namespace edgevo {
namespace {

void write_versions(YamlWriter* y) {
  y->open("edgevo");
  y->text("version", build_info::kVersion);
  y->text("git", build_info::kGitHash);
  y->text("build_type", build_info::kBuildType);
  y->text("compiler", build_info::kCompiler);
  y->close();
  y->open("libraries");
  y->text("mrpt", build_info::kMrpt);
  y->text("opencv", build_info::kOpenCv);
  y->text("ceres", build_info::kCeres);
  y->text("octomap", build_info::kOctomap);
  y->text("eigen", build_info::kEigen);
  y->close();
}

void write_source(const RunInfo& info, YamlWriter* y) {
  std::string command;
  for (const std::string& word : info.command_line) command += (command.empty() ? "" : " ") + word;
  y->text("command", command);
  y->open("source");
  y->text("kind", info.source_kind);
  y->text("path", info.source_path);
  if (!info.ground_truth_path.empty())
    y->text("ground_truth", std::filesystem::absolute(info.ground_truth_path).lexically_normal().string());
  y->boolean("interrupted", info.interrupted);
  y->close();
}

void write_input(const std::vector<InputDecision>& decisions, YamlWriter* y) {
  if (decisions.empty()) return;
  y->open("input");
  for (const InputDecision& d : decisions)
    y->text(d.subject, d.value + (d.reason.empty() ? "" : " (" + d.reason + ")"));
  y->close();
}

std::vector<std::string> all_warnings(const SummaryInput& input) {
  std::vector<std::string> warnings = input_warnings(input.info.input);
  for (std::string& warning : run_warnings(input.run)) warnings.push_back(std::move(warning));
  return warnings;
}

void write_scale(const Run& run, YamlWriter* y) {
  y->open("scale");
  y->text("source", run.scale_source);
  y->boolean("metric", run.is_metric());
  y->text("unit", unit_statement(run));
  if (run.is_metric()) {
    y->number("metres_per_unit", run.scale.factor, 6);
    y->number("relative_standard_deviation", run.scale.sigma, 5);
    y->number("lowest", run.scale.lowest, 6);
    y->number("highest", run.scale.highest, 6);
    y->integer("frames_not_measured", run.scale.frames_carried_over);
  }
  if (!run.scale.problem.empty()) y->text("problem", run.scale.problem);
  y->close();
}

void write_frames(const Run& run, YamlWriter* y) {
  const auto in_state = [&](TrackingState s) {
    return std::count_if(run.frames.begin(), run.frames.end(), [&](const auto& f) { return f.state == s; });
  };
  const int posed = count(run).with_pose;
  y->open("frames");
  y->integer("total", long(run.frames.size()));
  y->integer("bootstrapping", in_state(TrackingState::kBootstrapping));
  y->integer("tracking", in_state(TrackingState::kTracking));
  y->integer("degraded", in_state(TrackingState::kDegraded));
  y->integer("lost", in_state(TrackingState::kLost));
  y->integer("doubtful", count(run).doubtful);
  y->integer("with_pose", posed);
  y->number("coverage", run.frames.empty() ? 0.0 : double(posed) / double(run.frames.size()), 4);
  y->close();
}

// Sum of the distances between frames within segments.
double path_length(const Run& run) {
  double length = 0;
  const FrameRecord* last = nullptr;
  for (const FrameRecord& frame : run.frames) {
    if (!frame.T_world_cam) continue;
    if (last && last->segment == frame.segment)
      length += (frame.T_world_cam->translation() - last->T_world_cam->translation()).norm();
    last = &frame;
  }
  return length;
}

// How each segment but the first was joined to the one before.
std::vector<std::string> joins_in_words(const Run& run) {
  std::vector<std::string> lines;
  for (size_t s = 1; s < run.segments.size(); ++s)
    lines.push_back("segment " + std::to_string(s) + ": by " + run.segments[s].placed_by + ", scale +- " +
                    fixed(100 * run.segments[s].scale_sigma, 0) + " %");
  return lines;
}

void write_trajectory(const Run& run, YamlWriter* y) {
  std::set<int> segments;
  for (const FrameRecord& frame : run.frames)
    if (frame.segment >= 0) segments.insert(frame.segment);
  y->open("trajectory");
  y->integer("segments", long(segments.size()));
  y->integer("keyframes", long(run.keyframes.size()));
  y->integer("keyframes_doubtful", count(run).doubtful_keyframes);
  y->number("path_length", path_length(run), 6);
  y->close();
  y->list("segments_joined", joins_in_words(run));
}

}  // namespace

std::string summary_yaml(const SummaryInput& input) {
  YamlWriter y;
  write_versions(&y);
  write_source(input.info, &y);
  write_input(input.info.input, &y);
  write_camera(input.info.camera, &y);
  write_self_calibration(input.run.camera, &y);
  write_scale(input.run, &y);
  write_frames(input.run, &y);
  write_trajectory(input.run, &y);
  write_map(input.run, input.map, &y);
  write_timing(input, &y);
  write_realtime(input.run, &y);
  y.list("not_to_be_trusted", not_to_be_trusted(input.run));
  y.list("scale_faults", scale_faults_in_words(input.run));
  y.list("not_written", input.not_written);
  y.list("warnings", all_warnings(input));
  if (!input.info.notes.empty()) y.open("notes");
  for (const auto& [key, value] : input.info.notes) y.text(key, value);
  if (!input.info.notes.empty()) y.close();
  y.block("parameters", input.info.params_yaml);
  return y.str();
}

}  // namespace edgevo
