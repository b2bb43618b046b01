// SPDX-License-Identifier: BSD-3-Clause
// run(): a whole source in one call, as `edgevo run` takes it.
#include <chrono>
#include <map>
#include <utility>

#include "callbacks.h"
#include "classes.h"
#include "edgevo/core/error.h"
#include "edgevo/core/rectification.h"
#include "edgevo/datasets/describe.h"
#include "edgevo/run_loop/run_odometry.h"
#include "edgevo/scale/run_scaling.h"
#include "edgevo/scale/up_direction.h"
#include "run.h"
#include "run_parameters.h"
#include "source.h"

namespace edgevo::python {
namespace {

// What Python wants of a run on its way. All but the constructor is called without the GIL.
class PythonSide {
 public:
  explicit PythonSide(const Arguments& a) : progress_(a.function("progress")), log_(a.function("log")) {}

  bool has_log() const { return bool(log_); }
  void say(const std::string& line) { lines_.add(line); }
  /// Whether the run is to end: of a signal, such as Ctrl-C. To take the GIL costs milliseconds while another
  /// thread computes, so that it is done ten times a second.
  bool stop();
  /// Calls the callbacks; false: one has raised.
  bool after_frame(int done, std::optional<int> total);
  /// With the GIL: passes on the last lines, and raises what ended the run.
  void end();

 private:
  template <class Work>
  bool keep_error(Work&& work);

  py::object progress_, log_;
  GatheredLines lines_;
  std::exception_ptr error_;
  std::chrono::steady_clock::time_point checked_ = std::chrono::steady_clock::now();
};

template <class Work>
bool PythonSide::keep_error(Work&& work) {
  const py::gil_scoped_acquire gil;
  try {
    work();
  } catch (const std::exception&) {
    error_ = std::current_exception();
  }
  return !error_;
}

bool PythonSide::stop() {
  constexpr std::chrono::milliseconds kPeriod(100);
  if (error_) return true;
  const auto now = std::chrono::steady_clock::now();
  if (now - checked_ < kPeriod) return false;
  checked_ = now;
  return !keep_error([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
}

bool PythonSide::after_frame(int done, std::optional<int> total) {
  if (!progress_ && !log_) return true;
  return keep_error([&] {
    lines_.pass_to(log_);
    if (progress_) progress_(done, total ? py::object(py::int_(*total)) : py::none());
  });
}

void PythonSide::end() {
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  lines_.pass_to(log_);
}

struct Request {
  RunParams params;
  uint64_t seed = 1;
  std::string scale = "none", map;
};

class SourceRun {
 public:
  SourceRun(ImageSource& source, const Request& request, PythonSide& python);
  /// Runs to the end of the source. Throws what the source has thrown.
  RunContents track();

 private:
  bool after_frame(const ProcessedFrame& frame);

  ImageSource& source_;
  const Request& request_;
  PythonSide& python_;
  RunLoopOptions options_;
  std::optional<KeptPlaces> kept_;
  std::map<int, StoredKeyframe> keyframes_;
  RunScaling scaling_;
  MapCursor scale_events_;
  RunRecorder recorder_;
  int frames_ = 0;
};

RunLoopOptions loop_options(const ImageSource& source, const Request& request, PythonSide& python) {
  RunLoopOptions options;
  options.odometry = odometry_options(source.camera(), request.seed);
  if (python.has_log()) options.odometry.log = [&python](const std::string& line) { python.say(line); };
  options.past.scale = request.params.scale;
  options.past.places = request.params.places;
  options.on_bad_frame = OnBadFrame::kSkip;
  options.stop = [&python] { return python.stop(); };
  return options;
}

SourceRun::SourceRun(ImageSource& source, const Request& request, PythonSide& python)
    : source_(source),
      request_(request),
      python_(python),
      options_(loop_options(source, request, python)),
      scaling_(parse_scale_sources(request.scale), source,
               rectification_of(source.camera(), options_.odometry).target(), request.params.scale),
      scale_events_(options_.odometry.map_log),
      recorder_(options_.odometry.map_log) {
  if (options_.past.places.loops)
    options_.past.on_stored = [this](const StoredKeyframe& k) { keyframes_.insert_or_assign(k.id, k); };
  if (request.map.empty()) return;
  kept_ = read_map_for(request.map, source.camera(), options_.odometry,
                       request.scale == "none" ? "" : "scale=\"" + request.scale + "\"");
  for (const std::string& line : kept_->warnings()) python.say(line);
  options_.past.kept = kept_->places();
}

bool SourceRun::after_frame(const ProcessedFrame& frame) {
  recorder_.add(frame.record, frame.frame.image_path);
  for (const auto& event : scale_events_.read()) scaling_.apply(*event);
  return python_.after_frame(++frames_, source_.size());
}

RunContents SourceRun::track() {
  RunContents contents;
  contents.camera = source_.camera(), contents.map = request_.params.map;
  contents.scale = request_.scale, contents.tracks = scaling_.tracks();
  contents.info = describe_run(contents.camera, request_.params, options_.odometry);
  contents.info.source_kind = source_.kind();
  contents.info.ground_truth_path = source_.ground_truth_path();
  for (const InputDecision& decision : source_.decisions()) contents.info.input.push_back(decision);
  RunResult result = run_odometry(source_, request_.params.odometry, options_,
                                  [this](const ProcessedFrame& frame) { return after_frame(frame); });
  if (result.broken) std::rethrow_exception(result.broken);
  const std::optional<UpEstimate> by_gravity = result.up_by_gravity();
  contents.run = std::move(result.run);
  if (const auto up = decide_up(&contents.run, by_gravity)) contents.info.input.push_back(*up);
  scaling_.convert(&contents.run);
  if (kept_) finish_in_map(*kept_, &contents.run, [this](const std::string& line) { python_.say(line); });
  contents.keyframes = std::move(keyframes_);
  contents.frames = recorder_.take_frames();
  contents.events_at_end = recorder_.take_events();
  return contents;
}

// The source of the call, which `opened` then owns if it was a path.
PySource& source_argument(const Arguments& a, std::unique_ptr<PySource>* opened) {
  if (py::isinstance<PySource>(a.at("source"))) return py::cast<PySource&>(a.at("source"));
  if (py::hasattr(a.at("source"), "__next__")) a.refuse("source", "a path or a Source (derive it from it)");
  SourceOptions options;
  options.path = a.path("source");
  *opened = open(options);
  return **opened;
}

void say_opening(const PySource& source, PythonSide& python) {
  for (const std::string& line : opening_lines(source.options.path, *source.source)) python.say(line);
}

RunContents track(ImageSource& source, const Request& request, PythonSide& python) {
  const py::gil_scoped_release released;
  return SourceRun(source, request, python).track();
}

PyRun run(const Arguments& a) {
  std::unique_ptr<PySource> opened;
  PySource& source = source_argument(a, &opened);
  const InUse::Call call(source.in_use, "run()");
  const Request request{run_params(a, "params"), a.seed("seed", 1), a.has("scale") ? a.text("scale") : "none",
                        a.has("map") ? a.path("map") : ""};
  PythonSide python(a);
  std::unique_ptr<ImageSource> of_user;
  if (source.source)
    say_opening(source, python);
  else
    of_user = frames_of(py::reinterpret_borrow<py::object>(a.at("source")),
                        [&python](const std::string& line) { python.say(line); });
  auto contents = std::make_shared<RunContents>(track(of_user ? *of_user : *source.source, request, python));
  if (!contents->run.scale.problem.empty())
    python.say("the results are in an arbitrary unit: " + contents->run.scale.problem);
  python.end();
  if (contents->run.frames.empty())
    throw InputError(source.options.path.empty() ? "run(): source" : source.options.path, "has no frames",
                     "a Source can be read once");
  contents->info.source_path = source.options.path;
  return {std::move(contents)};
}

}  // namespace

void add_run_function(py::module_& module) {
  define_function(
      module, "run(source, params={}, seed=1, progress=None, *, scale='none', log=None, map=None)", run,
      "Runs a source to its end and returns the Run, with the poses of `edgevo run` to the last bit.\n\n"
      "source: a path as for open_source(), or a Source; params: dict of names and values (params());\n"
      "seed: equal seeds give equal results; progress(done, total): called after each frame, total may be\n"
      "None; scale: source of metres, such as 'camera_height=1.65'; log(line): called with a str; map: "
      "folder\n"
      "of an earlier run, or its map.db, whose frame and unit the run gets where it is recognised. What a\n"
      "callback raises, and Ctrl-C, ends the run and comes out. The GIL is released meanwhile.");
}

}  // namespace edgevo::python
