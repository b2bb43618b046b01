// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_session/run_session.h"

#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/thread_priority.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/describe.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/kept_map/map_file_writer.h"
#include "edgevo/run_loop/kept_places.h"
#include "edgevo/run_quality/closing_lines.h"
#include "edgevo/run_quality/run_statistics.h"
#include "edgevo/scale/run_scaling.h"
#include "edgevo/scale/up_direction.h"
#include "run_description.h"
#include "trace_file.h"

namespace edgevo {
namespace {

class RunSession {
 public:
  // Opens everything. The order is that of what a user is to hear of first.
  RunSession(const RunRequest& request, const RunHost& host);
  // Tracks all frames; to be followed by one of the next two.
  void track();
  // A run whose results are on disk, in the recovery log. Returns whether tracking did not fail.
  bool end_forgotten();
  // Writes the results. Returns whether they are good.
  bool finish();

 private:
  void warn(const std::string& line) const {
    if (!request_.quiet) host_.warn(line);
  }
  void print(const std::string& line) const {
    if (!request_.quiet) host_.print(line);
  }
  void warn_of(const std::vector<InputDecision>& decisions) const {
    for (const std::string& line : decision_lines(request_.source.path, decisions)) warn(line);
  }
  void find_camera();
  void open_source_with_notices();
  void choose_pinhole();
  void read_kept_map();
  void check_map_request() const;
  void extend_kept_map(const Run& run);
  void open_outputs();
  ShowFrame open_window() const;
  bool after_frame(const ProcessedFrame& frame);
  void prioritise_tracking() const;
  [[noreturn]] void throw_without_frames() const;
  void look_for_up();
  void print_end() const;

  RunRequest request_;
  const RunHost& host_;
  TraceFile trace_;
  const ScaleSources scale_;
  std::optional<AutoCamera> found_camera_;
  std::unique_ptr<ImageSource> source_;
  OdometryOptions odometry_;
  std::optional<InputDecision> pinhole_;
  std::optional<RunScaling> scaling_;
  std::optional<KeptPlaces> kept_map_;
  std::vector<Constraint> found_in_kept_map_;  // of the thread that recognises places, until the end
  RunInfo info_;
  std::optional<RunOutputs> outputs_;
  // While it runs.
  std::optional<MapCursor> scale_events_;
  std::optional<ProgressDisplay> progress_;
  ShowFrame show_;
  EgoMaskImage ego_mask_;
  int frames_ = 0, with_pose_ = 0;
  RunResult result_;
};

RunSession::RunSession(const RunRequest& request, const RunHost& host)
    : request_(request), host_(host), trace_(request.trace), scale_(parse_scale_sources(request.scale)) {
  check_apart(request_.source.path, request_.out);
  host_.listen_to_signals();
  find_camera();
  open_source_with_notices();
  odometry_.seed = request_.seed;
  odometry_.detectors = all_edge_detectors();
  odometry_.realtime = request_.realtime;
  odometry_.forget = request_.outputs.forget;
  odometry_.map_log = std::make_shared<MapLog>();
  if (const std::string& file = request_.source.camera_file; !file.empty())
    if (const std::optional<GyroModel> gyro = read_camera_gyro(file))
      odometry_.gyro = std::make_shared<const GyroModel>(*gyro);
  choose_pinhole();
  read_kept_map();
  scaling_.emplace(scale_, *source_, rectification_of(source_->camera(), odometry_).target(),
                   request_.params.scale);
  info_ = describe_run(request_, *source_, odometry_);
  if (pinhole_) info_.input.push_back(*pinhole_);
  if (found_camera_) note_found_camera(*found_camera_, &info_);
  open_outputs();
}

void RunSession::check_map_request() const {
  if (request_.outputs.forget)
    throw InputError("--map " + request_.map, "places are not looked for with --forget",
                     "omit one of the two");
  std::error_code ignored;
  if (std::filesystem::equivalent(map_file_of(request_.map), std::filesystem::path(request_.out) / kMapFile,
                                  ignored))
    throw InputError("--map " + request_.map, "is the folder for the results, too", "give another -o");
  if (!request_.extend_map) return;
  if (!request_.params.places.loops)
    throw InputError("--extend", "a run with --loops off keeps no keyframes", "omit one of the two");
  if (request_.scale != "none") throw InputError("--extend", "the map keeps its unit", "omit --scale");
}

void RunSession::extend_kept_map(const Run& run) {
  const std::string map = (std::filesystem::path(request_.out) / kMapFile).string();
  print(kept_map_->extend(run, map, found_in_kept_map_));
}

void RunSession::read_kept_map() {
  if (request_.map.empty()) return;
  check_map_request();
  kept_map_.emplace(request_.map, rectification_of(source_->camera(), odometry_).target(),
                    request_.scale == "none" ? "" : "--scale " + request_.scale);
  for (const std::string& line : kept_map_->warnings()) warn("edgevo: " + line);
}

void RunSession::find_camera() {
  if (request_.source.camera_file != kAutoCamera) return;
  const std::string where = request_.source.path;
  found_camera_.emplace(
      &request_.source, request_.seed,
      [&](const std::string& line) { warn("edgevo: " + where + ": camera, " + line); }, host_.stop);
  warn_of({found_camera_->decision()});
}

void RunSession::open_source_with_notices() {
  source_ = open_source(request_.source);
  for (const std::string& line : opening_lines(request_.source.path, *source_)) warn(line);
}

// The pinhole to work in, and what it is, unless it is that of the camera file.
void RunSession::choose_pinhole() {
  const Camera& camera = source_->camera();
  if (request_.target.is_empty() && camera.plumb_bob()) return;
  odometry_.working_pinhole = target_pinhole(camera, request_.target);
  pinhole_ = describe_target(camera, *odometry_.working_pinhole);
  warn("edgevo: " + request_.source.path + ": " + to_string(*pinhole_));
}

void RunSession::open_outputs() {
  OutputOptions options = request_.outputs;
  options.own_thread = request_.realtime;
  options.keep_map = request_.params.places.loops && !options.forget;
  outputs_.emplace(request_.out, source_->camera(), request_.params.map, options);
  outputs_->keep_recovery_log({info_, request_.scale, scaling_->tracks(), source_->T_vehicle_cam()},
                              odometry_.map_log);
}

// Empty without a window, or where it does not open, which is said.
ShowFrame RunSession::open_window() const {
  if (!host_.open_window) return {};
  std::string why;
  ShowFrame show = host_.open_window(source_->T_vehicle_cam(), odometry_.map_log, &why);
  if (!show) host_.warn("edgevo: --view: " + why + "; the run continues without a window");
  return show;
}

// Stores the image for the playback and the record on disk, updates the scale, the window and the progress.
bool RunSession::after_frame(const ProcessedFrame& frame) {
  ego_mask_ = frame.ego_mask;
  if (!outputs_->add_frame(frame.frame, frame.frame.image_path)) return false;
  outputs_->add_record(frame.record);
  if (outputs_->wants_views() && !frame.frame.image.empty())
    outputs_->add_view(frame.frame.time, frame.view());
  for (const auto& event : scale_events_->read()) scaling_->apply(*event);
  ++frames_;
  with_pose_ += frame.record.T_world_cam_live.has_value();
  if (progress_) progress_->update(frames_);
  return !show_ || show_(frame);
}

// Above all ordinary threads of the machine; the other threads of the run keep their priorities.
void RunSession::prioritise_tracking() const {
  constexpr int kPriority = 10;
  const std::string why = raise_thread_priority(kPriority);
  if (!why.empty()) host_.warn("edgevo: --priority: " + why + "; tracking runs at the usual priority");
}

void RunSession::track() {
  RunLoopOptions options;
  options.odometry = odometry_;
  options.past.scale = request_.params.scale, options.past.places = request_.params.places;
  if (kept_map_) options.past.kept = kept_map_->places();
  const auto add = [this](const StoredKeyframe& keyframe) { outputs_->add_keyframe(keyframe); };
  options.past.on_stored = add, options.past.on_young = add;
  options.past.on_found = [this](const Constraint& found) { found_in_kept_map_.push_back(found); };
  options.pace = request_.pace;
  options.on_bad_frame = request_.on_bad_frame;
  options.stop = host_.stop;
  if (request_.prioritise) prioritise_tracking();
  if (!request_.quiet) progress_ = host_.progress("tracking", source_->size());
  if (progress_) options.odometry.log = progress_->say;
  show_ = open_window();
  scale_events_.emplace(odometry_.map_log);
  result_ = run_odometry(*source_, request_.params.odometry, options,
                         [this](const ProcessedFrame& frame) { return after_frame(frame); });
  scale_events_.reset();
  show_ = {};
  options.odometry.log = {};
  progress_.reset();
}

// A run without a frame writes nothing and leaves the folder as it was.
void RunSession::throw_without_frames() const {
  if (result_.broken) std::rethrow_exception(result_.broken);
  if (host_.stop())
    throw InputError(request_.out, "interrupted before the first frame", "nothing was written");
  throw InputError(request_.source.path, "has no frames", "see `edgevo info` for its contents");
}

bool RunSession::end_forgotten() {
  if (frames_ == 0) throw_without_frames();
  outputs_->end_unfinished();
  trace_.close();
  print(formatted("%d frames, %d with a pose when they were processed", frames_, with_pose_));
  if (result_.run.realtime) print("the newest: " + latency_statement(result_.run));
  print("final poses and maps are not computed yet: `edgevo finish " + request_.out + "` writes them");
  if (result_.broken) std::rethrow_exception(result_.broken);
  if (2 * with_pose_ >= frames_) return true;
  host_.warn("edgevo: tracking failed for most of " + request_.source.path);
  return false;
}

// The mount of a camera that has none, if it was seen; a result and its doubt are said.
void RunSession::look_for_up() {
  const std::optional<InputDecision> up = decide_up(&result_.run, result_.up_by_gravity());
  if (!up) return;
  info_.input.push_back(*up);
  if (result_.run.T_vehicle_cam || !up->doubt.empty()) warn_of({*up});
}

void RunSession::print_end() const {
  const size_t frames = result_.run.frames.size();
  if (host_.stop()) print(formatted("interrupted after %zu frames", frames));
  if (const std::string places = statement_of(result_.places); !places.empty()) print(places);
  if (!result_.gyro.statement.empty()) print("gyro: " + result_.gyro.statement);
  if (result_.skipped > 0)
    print(formatted("%d of %zu frames skipped; the first: ", result_.skipped, frames) +
          result_.first_skipped);
}

bool RunSession::finish() {
  Run& run = result_.run;
  if (run.frames.empty()) throw_without_frames();
  look_for_up();
  scaling_->convert(&run);
  if (kept_map_) kept_map_->give_unit(&run);
  note_end(result_, host_.stop(), source_->T_vehicle_cam(), &info_);
  note_mask(ego_mask_, &info_);
  outputs_->finish(run, info_);
  trace_.close();
  print_end();
  if (kept_map_)
    kept_map_->is_found(run) ? print(kept_map_->statement(run))
                             : warn("edgevo: " + kept_map_->statement(run));
  if (!outputs_->map_note().empty()) warn(outputs_->map_note());
  for (const ClosingLine& line : closing_lines(run, request_.out, request_.outputs.include_doubtful))
    line.is_warning ? warn(line.text) : print(line.text);
  if (!outputs_->mcap_note().empty()) warn(outputs_->mcap_note());
  if (request_.extend_map && kept_map_ && kept_map_->is_found(run) && outputs_->map_note().empty())
    extend_kept_map(run);
  if (result_.broken) std::rethrow_exception(result_.broken);
  if (!run.scale.problem.empty())
    throw InputError(request_.out, "the results are in an arbitrary unit", run.scale.problem);
  const auto failure = failure_statement(run, request_.source.path, outputs_->earlier_run());
  if (failure) host_.warn("edgevo: " + *failure);
  return !failure;
}

}  // namespace

bool run_session(const RunRequest& request, const RunHost& host) {
  RunSession session(request, host);
  session.track();
  return request.outputs.forget ? session.end_forgotten() : session.finish();
}

}  // namespace edgevo
