// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <memory>

#include "auto_camera.h"
#include "commands.h"
#include "edgevo/core/closest_lens.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/thread_priority.h"
#include "edgevo/datasets/describe.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/results/run_outputs.h"
#include "edgevo/results/run_params.h"
#include "edgevo/run_loop/run_odometry.h"
#include "edgevo/run_quality/doubtful_intervals.h"
#include "edgevo/run_quality/run_statistics.h"
#include "edgevo/scale/run_scaling.h"
#include "edgevo/scale/up_direction.h"
#include "option_checks.h"
#include "print_run.h"
#include "progress.h"
#include "signals.h"
#include "source_options.h"
#include "trace_file.h"
#include "view_window.h"

namespace edgevo::app {
namespace {

constexpr int kDone = 0, kMostlyFailed = 3;

struct RunArguments {
  SourceOptions source;
  TargetRequest target;
  std::string out, params_file, detector, edge_model, edge_folder, edge_map, mask, scale = "none", trace;
  std::vector<std::string> settings;
  uint64_t seed = 1;
  bool realtime = false, quiet = false, view = false, prioritise = false;
  OnBadFrame on_bad_frame = OnBadFrame::kSkip;
  OutputOptions outputs;
  Pace pace;
  std::vector<std::string> command_line;
};

RunParams effective_params(const RunArguments& args) {
  RunParams params;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  if (!args.params_file.empty()) read_params_given(args.params_file, visit, args.quiet);
  for (const std::string& setting : args.settings) set_param(setting, visit);
  if (!args.detector.empty()) set_param("edges.detector=" + args.detector, visit);
  if (!args.edge_model.empty()) params.odometry.edges.model = args.edge_model;
  if (!args.edge_folder.empty()) params.odometry.edges.folder = args.edge_folder;
  if (!args.mask.empty()) params.odometry.edges.mask = args.mask;
  if (!args.edge_map.empty()) set_param("edge_map.mode=" + args.edge_map, visit);
  return params;
}

OnBadFrame parse_on_bad_frame(const std::string& text) {
  if (text == "skip") return OnBadFrame::kSkip;
  if (text == "stop") return OnBadFrame::kStop;
  throw InputError("--on-bad-frame " + text, "is neither stop nor skip", "give one of them");
}

// The pinhole to work in, and what it is, unless it is that of the camera file.
std::optional<InputDecision> choose_pinhole(const RunArguments& args, const Camera& camera,
                                            OdometryOptions* options) {
  if (args.target.is_empty() && camera.plumb_bob()) return std::nullopt;
  options->working_pinhole = target_pinhole(camera, args.target);
  InputDecision decision = describe_target(camera, *options->working_pinhole);
  if (!args.quiet)
    std::fprintf(stderr, "edgevo: %s: %s\n", args.source.path.c_str(), to_string(decision).c_str());
  return decision;
}

OdometryOptions odometry_options(const RunArguments& args) {
  OdometryOptions options;
  options.seed = args.seed;
  options.detectors = all_edge_detectors();
  options.realtime = args.realtime;
  options.forget = args.outputs.forget;
  return options;
}

RunInfo describe(const RunArguments& args, const ImageSource& source, RunParams params,
                 const OdometryOptions& odometry) {
  RunInfo info;
  info.command_line = args.command_line;
  info.source_kind = source.kind();
  info.source_path = args.source.path;
  info.ground_truth_path = source.ground_truth_path();
  info.camera = source.camera();
  info.input = source.decisions();
  info.working_pinhole = odometry.working_pinhole;
  info.params_yaml = write_params([&](ParamVisitor& v) { params.visit(v); });
  info.notes = {{"seed", std::to_string(args.seed)},
                {"mode", args.realtime ? "realtime, two threads" : "synchronous"}};
  if (args.outputs.forget)
    info.notes.emplace_back(kForgottenNote, "written by `edgevo finish` from what --forget has left on disk");
  for (const auto& notice : source_notices(source)) info.notes.push_back(notice);
  if (!info.camera.plumb_bob())
    info.notes.emplace_back("playback_camera",
                            "kannala_brandt, at most " +
                                fixed(closest_kannala_brandt(info.camera).max_error_px, 3) +
                                " px from the lens");
  return info;
}

// What a run that forgets its frames remembers of them.
struct FramesDone {
  int frames = 0, with_pose = 0;
};

// The newest mask of what is fixed to the camera.
using OwnPartMask = std::shared_ptr<const Plane<uint8_t>>;

// Work after each frame: store its image for the playback and its record on disk, update the scale, the
// window and the progress line.
std::function<bool(const ProcessedFrame&)> after_each_frame(RunOutputs& outputs, RunScaling& scaling,
                                                            MapCursor& scale_events, const ShowFrame& show,
                                                            std::optional<Progress>& progress,
                                                            OwnPartMask& own, FramesDone& done) {
  return [&](const ProcessedFrame& frame) {
    // A view is a projection of all points, and the mask hardly ever changes.
    constexpr int kFramesBetween = 10;
    if (frame.record.index % kFramesBetween == 0)
      if (const FrameView newest = frame.view(); newest.pyramid) own = newest.pyramid->own_mask;
    if (!outputs.add_frame(frame.frame, frame.frame.image_path)) return false;
    outputs.add_record(frame.record);
    for (const auto& event : scale_events.read()) scaling.apply(*event);
    ++done.frames;
    done.with_pose += frame.record.T_world_cam_live.has_value();
    if (progress) progress->update(done.frames);
    return !show || show(frame);
  };
}

// Empty without --view, or where the window does not open, which is said.
ShowFrame view_from(const RunArguments& args, const ImageSource& source, const std::shared_ptr<MapLog>& log) {
  if (!args.view) return {};
  std::string why;
  ShowFrame show = open_view_window(source.T_vehicle_cam(), log, interrupted, &why);
  if (!show) std::fprintf(stderr, "edgevo: --view: %s; the run continues without a window\n", why.c_str());
  return show;
}

// Above all ordinary threads of the machine; the other threads of the run keep their priorities.
void prioritise_tracking() {
  constexpr int kPriority = 10;
  const std::string why = raise_thread_priority(kPriority);
  if (why.empty()) return;
  std::fprintf(stderr, "edgevo: --priority: %s; tracking runs at the usual priority\n", why.c_str());
}

RunResult run_over(const RunArguments& args, ImageSource& source, const OdometryParams& params,
                   const OdometryOptions& odometry, RunScaling& scaling, RunOutputs& outputs,
                   OwnPartMask* own, FramesDone* done) {
  RunLoopOptions options;
  options.odometry = odometry;
  options.pace = args.pace;
  options.on_bad_frame = args.on_bad_frame;
  options.stop = interrupted;
  if (args.prioritise) prioritise_tracking();
  std::optional<Progress> progress;
  if (!args.quiet) progress.emplace("tracking", source.size());
  if (!args.quiet) options.odometry.log = [&](const std::string& line) { progress->say(line); };
  const ShowFrame show = view_from(args, source, odometry.map_log);
  MapCursor scale_events(odometry.map_log);
  return run_odometry(source, params, options,
                      after_each_frame(outputs, scaling, scale_events, show, progress, *own, *done));
}

// A run without a frame writes nothing and leaves the folder as it was.
[[noreturn]] void throw_without_frames(const RunArguments& args, const RunResult& result) {
  if (result.broken) std::rethrow_exception(result.broken);
  if (interrupted()) throw InputError(args.out, "interrupted before the first frame", "nothing was written");
  throw InputError(args.source.path, "has no frames", "see `edgevo info` for its contents");
}

void note_end(const RunResult& result, RunInfo* info) {
  info->interrupted = result.broken || interrupted();
  if (result.skipped == 0) return;
  info->notes.emplace_back("left_out", std::to_string(result.skipped) +
                                           " frame(s) whose images or times could not be used; the first: " +
                                           result.first_skipped);
}

// The mount of a camera that has none, if it was seen; a result and its doubt are said.
void look_for_up(const RunArguments& args, Run* run, RunInfo* info) {
  const std::optional<InputDecision> up = decide_up(run);
  if (!up) return;
  info->input.push_back(*up);
  if (!args.quiet && (run->T_vehicle_cam || !up->doubt.empty())) print_decisions(args.source.path, {*up});
}

void note_mask(const OwnPartMask& own, RunInfo* info) {
  if (!own) return;
  info->own_mask = {own->width(), own->height(), {}};
  int masked = 0;
  for (int y = 0; y < own->height(); ++y)
    for (int x = 0; x < own->width(); ++x) {
      info->own_mask.pixels.push_back(own->at(x, y) ? 0 : 255);
      masked += own->at(x, y) != 0;
    }
  char text[80];
  std::snprintf(text, sizeof text, "%.0f %% of the image is fixed to the camera and left out: mask.png",
                100.0 * masked / double(info->own_mask.pixels.size()));
  info->notes.emplace_back("mask", text);
}

void print_end(const RunResult& result) {
  if (interrupted()) std::printf("interrupted after %zu frames\n", result.run.frames.size());
  if (result.skipped > 0)
    std::printf("%d of %zu frames skipped; the first: %s\n", result.skipped, result.run.frames.size(),
                result.first_skipped.c_str());
}

// A run whose results are on disk, in the recovery log.
int end_forgotten(const RunArguments& args, const RunResult& result, const FramesDone& done,
                  RunOutputs* outputs, TraceFile* trace) {
  if (done.frames == 0) throw_without_frames(args, result);
  outputs->end_unfinished();
  trace->close();
  if (!args.quiet) {
    std::printf("%d frames, %d with a pose when they were processed\n", done.frames, done.with_pose);
    if (result.run.realtime) std::printf("the newest: %s\n", latency_statement(result.run).c_str());
    std::printf("final poses and maps are not computed yet: `edgevo finish %s` writes them\n",
                args.out.c_str());
  }
  if (result.broken) std::rethrow_exception(result.broken);
  if (2 * done.with_pose >= done.frames) return kDone;
  std::fprintf(stderr, "edgevo: tracking failed for most of %s\n", args.source.path.c_str());
  return kMostlyFailed;
}

// Replaces what the source says of its camera.
void note_found_camera(const AutoCamera& camera, RunInfo* info) {
  info->camera_file = camera.found();
  auto& input = info->input;
  input.erase(std::remove_if(input.begin(), input.end(), [](const auto& d) { return d.subject == "camera"; }),
              input.end());
  input.push_back(camera.decision());
}

int run(const RunArguments& given) {
  if (given.view) become_program_with_window(given.command_line);
  RunArguments args = given;
  const RunParams params = effective_params(args);
  TraceFile trace(args.trace);
  const ScaleSource scale = parse_scale_source(args.scale);
  check_apart(args.source.path, args.out);
  listen_to_signals();
  std::optional<AutoCamera> found_camera;
  if (args.source.camera_file == kAutoCamera) found_camera.emplace(&args.source, args.seed, args.quiet);
  if (found_camera && !args.quiet) print_decisions(args.source.path, {found_camera->decision()});
  const std::unique_ptr<ImageSource> source = open_source_with_notices(args.source, args.quiet);
  OdometryOptions odometry = odometry_options(args);
  odometry.map_log = std::make_shared<MapLog>();
  const std::optional<InputDecision> pinhole = choose_pinhole(args, source->camera(), &odometry);
  RunScaling scaling(scale, *source, rectification_of(source->camera(), odometry).target(), params.scale);
  RunInfo info = describe(args, *source, params, odometry);
  if (pinhole) info.input.push_back(*pinhole);
  if (found_camera) note_found_camera(*found_camera, &info);
  OutputOptions output_options = args.outputs;
  output_options.own_thread = args.realtime;
  RunOutputs outputs(args.out, source->camera(), params.map, output_options);
  outputs.keep_recovery_log({info, args.scale, scaling.track(), source->T_vehicle_cam()}, odometry.map_log);
  OwnPartMask own;
  FramesDone done;
  RunResult result = run_over(args, *source, params.odometry, odometry, scaling, outputs, &own, &done);
  if (args.outputs.forget) return end_forgotten(args, result, done, &outputs, &trace);
  Run& tracked = result.run;
  if (tracked.frames.empty()) throw_without_frames(args, result);
  look_for_up(args, &tracked, &info);
  scaling.convert(&tracked);
  note_end(result, &info);
  note_mask(own, &info);
  outputs.finish(tracked, info);
  trace.close();
  if (!args.quiet) print_end(result);
  if (!args.quiet && !outputs.map_note().empty()) std::fprintf(stderr, "%s\n", outputs.map_note().c_str());
  if (!args.quiet) print_run(tracked, args.out, args.outputs.include_doubtful);
  if (result.broken) std::rethrow_exception(result.broken);
  if (!tracked.scale.problem.empty())
    throw InputError(args.out, "the results are in an arbitrary unit", tracked.scale.problem);
  return print_failure(tracked, args.source.path, outputs.earlier_run());
}

}  // namespace

void add_run_command(CLI::App& app, Action* action, std::vector<std::string> command_line) {
  CLI::App* command = app.add_subcommand("run", "run the odometry on a source: trajectory and edge map");
  auto args = std::make_shared<RunArguments>();
  args->command_line = std::move(command_line);
  add_source_options(*command, &args->source);
  add_mount(*command, &args->source.mount);
  add_image_scale(*command, &args->source);
  add_rectification(*command, &args->target);
  command
      ->add_option("-o,--out", args->out,
                   "folder for the results, created if missing; an earlier run in it is kept until this one "
                   "has a pose")
      ->required()
      ->check(path_given());
  command->add_option("--params", args->params_file,
                      "YAML file of parameters (edgevo help parameters), or summary.yaml of a run; others "
                      "keep their defaults");
  command
      ->add_option("--set", args->settings,
                   "set a parameter (edgevo help parameters), GROUP.KEY=VALUE; repeatable")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--detector", args->detector,
                      "edge detector: " + edge_detector_help(all_edge_detectors()));
  command
      ->add_option("--edge-model", args->edge_model,
                   "model for the detectors structured (a forest in OpenCV's format) and network (an .onnx "
                   "with its .yaml next to it), instead of the one shipped with edgevo")
      ->check(path_given());
  command
      ->add_option(
          "--mask", args->mask,
          "PNG of the shape of the images: what is black there, such as a part of the vehicle, is left out")
      ->check(path_given());
  command
      ->add_option("--edge-folder", args->edge_folder,
                   "folder written by `edgevo edges`, for the detector precomputed")
      ->check(path_given());
  command->add_option(
      "--edge-map", args->edge_map,
      "edge lines besides the points: off, keyframes (per keyframe), full (each 3D edge once; default)");
  command
      ->add_option("--seed", args->seed,
                   "seed of all random numbers; synchronous runs with the same seed are bit-identical")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()));
  command->add_option(
      "--scale", args->scale,
      "source of metric scale: none (arbitrary unit), factor=METRES_PER_UNIT, odometry, gps or "
      "robot_pose (from the rawlog), camera_height=METRES (above the ground)");
  CLI::Option* realtime =
      command->add_flag("--realtime", args->realtime,
                        "run tracking and mapping in two threads and measure latencies; not bit-identical");
  command
      ->add_option_function<std::string>(
          "--pace", [args](const std::string& text) { args->pace = parse_pace(text); },
          "with --realtime, playback rate of a recording: 30 (frames per second), 1x (by its timestamps), "
          "0.5x (half speed); default: each frame as soon as the previous one is done")
      ->needs(realtime);
  command
      ->add_option("--trace", args->trace,
                   "file for a trace of the run: what each thread did, and when (Chrome's trace format)")
      ->check(path_given());
  command->add_flag("--view", args->view,
                    "show edges and map in a window; space pauses, s steps, c changes colours, f follows the "
                    "camera, q ends "
                    "the run");
  command->add_option_function<std::string>(
      "--on-bad-frame", [args](const std::string& text) { args->on_bad_frame = parse_on_bad_frame(text); },
      "unusable image or time: skip (default) continues as if the camera had dropped the frame and notes it "
      "in frames.csv and summary.yaml; stop ends the run there with all results so far. The first image must "
      "be usable either way");
  command->add_flag("--forget", args->outputs.forget,
                    "for runs of any length: what is on disk leaves the memory; `edgevo finish OUT` writes "
                    "final poses and maps");
  command->add_flag("--priority", args->prioritise,
                    "give tracking the real-time priority of the system (SCHED_FIFO), where that is allowed");
  command->add_flag("--copy-images", args->outputs.copy_images,
                    "copy the images of the playback instead of linking them, so that OUT is self-contained");
  add_include_doubtful(*command, &args->outputs.include_doubtful);
  command->add_flag("--force", args->outputs.force,
                    "write into a folder that holds other files or an interrupted run");
  command->add_flag("--quiet", args->quiet, "print nothing but errors");
  command->footer(
      "Ctrl-C ends the run with all results so far; the exit code is the same as at the end of the source. "
      "`edgevo finish OUT` writes the results of a run that was killed.");
  command->callback([=] { *action = [=] { return run(*args); }; });
}

}  // namespace edgevo::app
