#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/run_statistics.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/drive/drive.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/results/run_outputs.h"
#include "edgevo/results/run_params.h"
#include "edgevo/scale/run_scaling.h"
#include "edgevo/viewer/run_view.h"
#include "option_checks.h"
#include "print_run.h"
#include "progress.h"
#include "signals.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

constexpr int kDone = 0, kMostlyFailed = 3;

struct RunArguments {
  SourceOptions source;
  std::string out, params_file, detector, edge_model, edge_folder, edge_map, scale = "none";
  std::vector<std::string> settings;
  uint64_t seed = 1;
  bool realtime = false, quiet = false, view = false;
  OnBadFrame on_bad_frame = OnBadFrame::kSkip;
  OutputOptions outputs;
  Pace pace;
  std::vector<std::string> command_line;
};

RunParams effective_params(const RunArguments& args) {
  RunParams params;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  if (!args.params_file.empty()) read_params_file(args.params_file, visit);
  for (const std::string& setting : args.settings) set_param(setting, visit);
  if (!args.detector.empty()) set_param("edges.detector=" + args.detector, visit);
  if (!args.edge_model.empty()) params.odometry.edges.model = args.edge_model;
  if (!args.edge_folder.empty()) params.odometry.edges.folder = args.edge_folder;
  if (!args.edge_map.empty()) set_param("edge_map.mode=" + args.edge_map, visit);
  return params;
}

OnBadFrame parse_on_bad_frame(const std::string& text) {
  if (text == "skip") return OnBadFrame::kSkip;
  if (text == "stop") return OnBadFrame::kStop;
  throw InputError("--on-bad-frame " + text, "is neither stop nor skip", "give one of them");
}

RunInfo describe(const RunArguments& args, const ImageSource& source, RunParams params) {
  RunInfo info;
  info.command_line = args.command_line;
  info.source_kind = source.kind();
  info.source_path = args.source.path;
  info.ground_truth_path = source.ground_truth_path();
  info.camera = source.camera();
  info.params_yaml = write_params([&](ParamVisitor& v) { params.visit(v); });
  info.notes = {{"seed", std::to_string(args.seed)},
                {"mode", args.realtime ? "realtime, two threads" : "synchronous"}};
  for (const auto& told : to_be_told(source)) info.notes.push_back(told);
  return info;
}

// Hands each frame over to the scale, with the keyframes that have settled since the one before.
class ScaleFeed {
 public:
  explicit ScaleFeed(RunScaling& scaling) : scaling_(scaling) {}

  void add(const DrivenFrame& driven) {
    if (!scaling_.is_estimated()) return;
    const SettledKeyframes settled = driven.odometry.settled_keyframes(fed_);
    fed_ += settled.keyframes.size();
    scaling_.add_frame(driven.record, settled.keyframes);
  }

 private:
  RunScaling& scaling_;
  size_t fed_ = 0;  // keyframes
};

// What is to be done after each frame: keep its image for the playback and what was found on disk, measure
// the scale, show the frame, and show how far we are.
std::function<bool(const DrivenFrame&)> after_each_frame(RunOutputs& outputs, RunScaling& scaling,
                                                         RunView* view, std::optional<Progress>& progress) {
  return [&outputs, scale_feed = ScaleFeed(scaling), view, &progress,
          done = 0](const DrivenFrame& driven) mutable {
    if (!outputs.add_frame(driven.frame, driven.frame.image_path)) return false;
    outputs.add_record(driven.record, driven.odometry);
    scale_feed.add(driven);
    if (progress) progress->update(++done);
    return !view || view->show(driven, interrupted);
  };
}

std::unique_ptr<RunView> view_from(const RunArguments& args, const ImageSource& source) {
  if (!args.view) return nullptr;
  std::string why;
  auto view = RunView::open(source.T_vehicle_cam(), &why);
  if (!view) std::fprintf(stderr, "edgevo: --view: %s; the run goes on without a window\n", why.c_str());
  return view;
}

Drive drive_from(const RunArguments& args, ImageSource& source, const OdometryParams& params,
                 RunScaling& scaling, RunOutputs& outputs) {
  DriveOptions options;
  options.odometry.seed = args.seed;
  options.odometry.detectors = all_edge_detectors();
  options.odometry.realtime = args.realtime;
  options.pace = args.pace;
  options.on_bad_frame = args.on_bad_frame;
  options.stop = interrupted;
  std::optional<Progress> progress;
  if (!args.quiet) progress.emplace("tracking", source.size());
  if (!args.quiet) options.odometry.log = [&](const std::string& line) { progress->say(line); };
  const auto view = view_from(args, source);
  return drive(source, params, options, after_each_frame(outputs, scaling, view.get(), progress));
}

// A run without a frame: nothing is written, and what the folder holds stays.
[[noreturn]] void throw_without_frames(const RunArguments& args, const Drive& driven) {
  if (driven.broken) std::rethrow_exception(driven.broken);
  if (interrupted()) throw InputError(args.out, "interrupted before the first frame", "nothing was written");
  throw InputError(args.source.path, "gave no frame", "see `edgevo info` for what is in it");
}

void note_end(const Drive& driven, RunInfo* info) {
  info->interrupted = driven.broken || interrupted();
  if (driven.left_out == 0) return;
  info->notes.emplace_back(
      "left_out", std::to_string(driven.left_out) +
                      " frame(s) whose images could not be used; the first: " + driven.first_left_out);
}

void print_end(const Drive& driven) {
  if (interrupted()) std::printf("interrupted after %zu frames\n", driven.run.frames.size());
  if (driven.left_out > 0)
    std::printf("%d of %zu frames left out; the first: %s\n", driven.left_out, driven.run.frames.size(),
                driven.first_left_out.c_str());
}

void print_failure(const RunArguments& args, const RunOutputs& outputs) {
  const std::string earlier = outputs.earlier_run();
  std::fprintf(stderr, "edgevo: tracking failed for most of %s; see the notes in %s/frames.csv%s\n",
               args.source.path.c_str(), args.out.c_str(),
               earlier.empty() ? "" : ("; the run before is kept in " + earlier).c_str());
}

int run(const RunArguments& args) {
  const RunParams params = effective_params(args);
  const ScaleSource scale = parse_scale_source(args.scale);
  check_apart(args.source.path, args.out);
  const std::unique_ptr<ImageSource> source = open_and_tell(args.source);
  RunScaling scaling(scale, *source, params.scale);
  RunInfo info = describe(args, *source, params);
  RunOutputs outputs(args.out, source->camera(), params.map, args.outputs);
  outputs.keep_journal({info, args.scale, scaling.track(), source->T_vehicle_cam()});
  listen_to_signals();
  Drive driven = drive_from(args, *source, params.odometry, scaling, outputs);
  Run& result = driven.run;
  if (result.frames.empty()) throw_without_frames(args, driven);
  scaling.apply(&result);
  note_end(driven, &info);
  outputs.finish(result, info);
  if (!args.quiet) print_end(driven);
  if (!args.quiet) print_run(result, args.out);
  if (driven.broken) std::rethrow_exception(driven.broken);
  if (!result.scale.problem.empty())
    throw InputError(args.out, "the results are in an arbitrary unit", result.scale.problem);
  if (!count(result).mostly_failed()) return kDone;
  print_failure(args, outputs);
  return kMostlyFailed;
}

}  // namespace

void add_run_command(CLI::App& app, Action* action, std::vector<std::string> command_line) {
  CLI::App* command = app.add_subcommand("run", "odometry: trajectory and edge map of a source");
  auto args = std::make_shared<RunArguments>();
  args->command_line = std::move(command_line);
  add_source_options(*command, &args->source);
  add_image_scale(*command, &args->source);
  command
      ->add_option("-o,--out", args->out,
                   "folder for the results; made if it is not there. An earlier run in it stays until this "
                   "one has a pose")
      ->required()
      ->check(path_given());
  command->add_option("--params", args->params_file,
                      "YAML file of parameters; what it does not name keeps its default");
  command->add_option("--set", args->settings, "one parameter, GROUP.KEY=VALUE; may be given again")
      ->take_all();
  command->add_option("--detector", args->detector,
                      "edge detector: " + edge_detector_help(all_edge_detectors()));
  command
      ->add_option("--edge-model", args->edge_model,
                   "for the detectors structured (a forest in OpenCV's format) and network (an .onnx with "
                   "its .yaml beside it): "
                   "another model than the one that comes with edgevo")
      ->check(path_given());
  command
      ->add_option("--edge-folder", args->edge_folder,
                   "for the detector precomputed: the folder that `edgevo edges` has written")
      ->check(path_given());
  command->add_option(
      "--edge-map", args->edge_map,
      "lines of edges beside the points: off, keyframes (those of each), full (each 3D edge once; default)");
  command
      ->add_option("--seed", args->seed,
                   "seed of all random choices; a synchronous run with one seed is bit-identical")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()));
  command->add_option(
      "--scale", args->scale,
      "where the metre comes from: none (arbitrary unit), factor=METRES_PER_UNIT, odometry, gps, robot_pose "
      "(of the rawlog), camera_height=METRES (over the ground it drives on)");
  CLI::Option* realtime =
      command->add_flag("--realtime", args->realtime,
                        "tracking and mapping in two threads, latencies measured; not bit-identical");
  command
      ->add_option_function<std::string>(
          "--pace", [args](const std::string& text) { args->pace = parse_pace(text); },
          "with --realtime: when frames of a recording are due: 30 (a second), 1x (as their times say), 0.5x "
          "(half as fast); without it "
          "each as soon as the one before is done")
      ->needs(realtime);
  command->add_flag(
      "--view", args->view,
      "a window with the edges and the map; space pauses, s steps, c colours, f follows, q ends the run");
  command->add_option_function<std::string>(
      "--on-bad-frame", [args](const std::string& text) { args->on_bad_frame = parse_on_bad_frame(text); },
      "an image that cannot be used: skip (default) leaves it out, as a camera that missed it would, since "
      "one bad "
      "image in hours must not cost the rest; frames.csv and summary.yaml name it. stop ends the run there, "
      "with "
      "all results so far. The first image has to be good either way");
  command->add_flag("--copy-images", args->outputs.copy_images,
                    "the images of the playback are copied, not linked: OUT then stands alone");
  command->add_flag("--force", args->outputs.force,
                    "write into a folder that holds something else than a run, or a run that was cut off");
  command->add_flag("--quiet", args->quiet, "print nothing but errors");
  command->footer(
      "Ctrl-C ends the run with all results so far; the exit code is then what it is at the end of a "
      "source. What a run that was killed had found, `edgevo finish OUT` writes.");
  command->callback([=] { *action = [=] { return run(*args); }; });
}

}  // namespace edgevo::app
