// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/odometry/odometry.h"

#include <atomic>
#include <map>
#include <utility>

#include "callbacks.h"
#include "classes.h"
#include "edgevo/core/error.h"
#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/record_units.h"
#include "edgevo/core/rectification.h"
#include "edgevo/places/view_locator.h"
#include "edgevo/run_loop/kept_places.h"
#include "edgevo/run_loop/past_follower.h"
#include "edgevo/scale/up_direction.h"
#include "event.h"
#include "frame.h"
#include "gyro_input.h"
#include "image_input.h"
#include "in_use.h"
#include "run.h"
#include "run_parameters.h"

namespace edgevo::python {
namespace {

class PyOdometry {
 public:
  explicit PyOdometry(const Arguments& a);
  FrameRecord process(const Arguments& a);
  void add_gyro(const Arguments& a);
  std::string gyro();
  bool is_in_map() const { return is_in_map_; }
  PyRun finish();

 private:
  void require_open(const char* where) const;
  void read_frame(const Arguments& a);
  void check_time(const Arguments& a) const;
  void open(const std::string& map);
  void follow(const FrameRecord& record);
  void report(const FrameRecord& record);

  Camera camera_;
  RunParams params_;
  py::object on_event_, log_;
  GatheredLines lines_;
  OdometryOptions options_;
  RunInfo info_;
  std::optional<RunRecorder> recorder_;
  std::optional<MapCursor> events_;
  std::optional<KeptPlaces> kept_;
  std::optional<MapCursor> placements_;      // for kept_
  std::map<int, StoredKeyframe> keyframes_;  // by id
  std::atomic<bool> is_in_map_ = false;      // read by any thread
  std::optional<PastFollower> past_;         // as run_odometry(): equal frames give equal bytes
  std::unique_ptr<Odometry> odometry_;
  ImageInput images_;
  Frame frame_;
  std::optional<Frame> newest_;  // without its image
  std::optional<TrackingState> state_;
  bool is_finished_ = false;
  InUse in_use_;
};

const Camera& camera_argument(const Arguments& a) {
  if (!py::isinstance<Camera>(a.at("camera"))) a.refuse("camera", "a Camera");
  return py::cast<const Camera&>(a.at("camera"));
}

PyOdometry::PyOdometry(const Arguments& a)
    : camera_(camera_argument(a)),
      params_(run_params(a, "params")),
      on_event_(a.function("on_event")),
      log_(a.function("log")),
      options_(odometry_options(camera_, a.seed("seed", 1))),
      images_(camera_) {
  options_.realtime = a.flag("realtime", false);
  options_.forget = a.flag("forget", false);
  if (log_) options_.log = [this](const std::string& line) { lines_.add(line); };
  info_ = describe_run(camera_, params_, options_);
  if (!options_.forget) recorder_.emplace(options_.map_log);
  if (on_event_) events_.emplace(options_.map_log);
  const std::string map = a.has("map") ? a.path("map") : "";
  const py::gil_scoped_release released;
  open(map);
}

// Without the GIL.
void PyOdometry::open(const std::string& map) {
  PastParams past;
  past.scale = params_.scale, past.places = params_.places;
  if (!map.empty()) {
    if (options_.forget)
      throw InputError("Odometry(): map", "places are not looked for with forget=True",
                       "omit one of the two");
    kept_ = read_map_for(map, camera_, options_, "");
    for (const std::string& line : kept_->warnings()) lines_.add(line);
    placements_.emplace(options_.map_log);
    past.kept = kept_->places();
    options_.locate = locate_in(past.kept);
  }
  // Called in the thread that recognises places; read after it has ended.
  if (!options_.forget && past.places.loops)
    past.on_stored = [this](const StoredKeyframe& k) { keyframes_.insert_or_assign(k.id, k); };
  past_.emplace(camera_, std::nullopt, options_, past);
  odometry_ = std::make_unique<Odometry>(camera_, params_.odometry, options_);
}

void PyOdometry::require_open(const char* where) const {
  if (is_finished_)
    throw std::runtime_error(std::string(where) + ": finish() has ended the run; make a new Odometry");
}

// An int that was meant as seconds is noticed by how little it differs from the one before.
void PyOdometry::check_time(const Arguments& a) const {
  constexpr double kShortestStep_s = 1e-5;
  if (!newest_) return;
  const double step_s = seconds_between(newest_->time, frame_.time);
  const std::string before = to_string(newest_->time) + " s, that of the frame before";
  const bool is_int = whole_number(a.at("time")).has_value();
  if (is_int && step_s < kShortestStep_s && step_s > -kShortestStep_s)
    throw bad_value(a.where("time"), "is " + describe(a.at("time")) + ", in nanoseconds, next to " + before,
                    "give seconds as float");
  if (step_s <= 0)
    throw bad_value(a.where("time"), "is " + to_string(frame_.time) + " s, not after " + before,
                    "give images in the order of their times");
}

void PyOdometry::read_frame(const Arguments& a) {
  if (py::isinstance<PyFrame>(a.at("image"))) {
    if (a.has("time"))
      throw py::type_error(a.where("time") + " came with a Frame, which has its own; omit it");
    frame_ = *py::cast<const PyFrame&>(a.at("image")).frame;
    return;
  }
  if (!a.has("time")) throw py::type_error(a.where("time") + " is missing; wanted process(image, time)");
  frame_.image_path.clear();
  images_.read(a.at("image"), a.where("image"), &frame_.image);
  frame_.time = a.time("time");
  check_time(a);
  frame_.index = newest_ ? newest_->index + 1 : 0;
}

// Without the GIL.
void PyOdometry::follow(const FrameRecord& record) {
  past_->follow();
  if (kept_) kept_->follow(placements_->read()), is_in_map_ = kept_->is_placed();
  if (recorder_) recorder_->add(record, frame_.image_path);
  newest_ = Frame{frame_.index, frame_.time, {}, {}};
}

// What callbacks raise comes out; the frame has been processed by then.
void PyOdometry::report(const FrameRecord& record) {
  for (const std::string& line : images_.take_notes()) lines_.add(line);
  lines_.pass_to(log_);
  if (!on_event_) return;
  const bool is_new_state = state_ != record.state;
  state_ = record.state;
  const auto events = events_->read();
  for (const auto& event : events)
    if (const auto converted = to_event(*event, record.index)) on_event_(*converted);
  if (is_new_state) on_event_(state_event(record));
}

FrameRecord PyOdometry::process(const Arguments& a) {
  const InUse::Call call(in_use_, "Odometry.process()");
  require_open("Odometry.process()");
  read_frame(a);
  FrameRecord record;
  {
    const py::gil_scoped_release released;
    record = odometry_->process(frame_);
    follow(record);
  }
  report(record);
  return record;
}

void PyOdometry::add_gyro(const Arguments& a) {
  const InUse::Call call(in_use_, "Odometry.add_gyro()");
  require_open("Odometry.add_gyro()");
  odometry_->add_gyro(gyro_sample(a.at("time"), a.where("time"), a.at("rate"), a.where("rate")));
}

std::string PyOdometry::gyro() {
  const InUse::Call call(in_use_, "Odometry.gyro");
  require_open("Odometry.gyro");
  return odometry_->gyro().statement;
}

PyRun PyOdometry::finish() {
  const InUse::Call call(in_use_, "Odometry.finish()");
  require_open("Odometry.finish()");
  is_finished_ = true;
  auto contents = std::make_shared<RunContents>();
  {
    const py::gil_scoped_release released;
    odometry_->close();
    past_->finish();
    contents->run = odometry_->finish();
    odometry_.reset();
    if (const auto up = decide_up(&contents->run)) info_.input.push_back(*up);
    if (kept_) finish_in_map(*kept_, &contents->run, [this](const std::string& line) { lines_.add(line); });
    is_in_map_ = is_in_kept_map(contents->run);
    contents->keyframes = std::exchange(keyframes_, {});
    if (recorder_)
      contents->frames = recorder_->take_frames(), contents->events_at_end = recorder_->take_events();
    contents->camera = camera_, contents->info = info_, contents->map = params_.map;
  }
  events_.reset(), recorder_.reset(), past_.reset(), placements_.reset(), kept_.reset();
  options_.locate = {};  // it holds the map
  on_event_ = py::object();
  lines_.pass_to(std::exchange(log_, py::object()));
  return PyRun{std::move(contents)};
}

}  // namespace

void add_odometry(py::module_& module) {
  py::class_<PyOdometry> odometry(
      module, "Odometry",
      "Images in, poses out, as they come.\n\n"
      "params: dict of names and values (params()); seed: equal seeds give equal results; realtime:\n"
      "tracks and maps in threads of their own, for a live camera; on_event(event): called with each Event;\n"
      "log(line): called with a str; forget: keeps nothing in memory, for runs of any length: finish() then\n"
      "returns the newest frames only; map: folder of an earlier run, or its map.db, in which this one is\n"
      "placed. Callbacks are called in the thread of process(), after the frame.");
  define_init(odometry,
              "Odometry(camera, params={}, seed=1, realtime=False, on_event=None, log=None, *, forget=False, "
              "map=None)",
              [](const Arguments& a) { return std::make_unique<PyOdometry>(a); });
  define(
      odometry, "Odometry.process(image, time=None)",
      [](PyOdometry& o, const Arguments& a) { return o.process(a); },
      "Processes the next image and returns its Record. The GIL is released meanwhile.\n\n"
      "image: array in C order, uint8 H x W, uint8 H x W x 3 (blue, green, red; converted to gray) or "
      "uint16\n"
      "H x W (scaled), read during the call only; time: seconds as float, or nanoseconds as int. Or a Frame\n"
      "alone, which has both. After an error in an argument nothing has happened.");
  define(
      odometry, "Odometry.add_gyro(time, rate)", [](PyOdometry& o, const Arguments& a) { o.add_gyro(a); },
      "Takes a sample of a gyro that is fixed to the camera, before the image that it belongs to.\n\n"
      "time: as that of the images, in their clock to 0.2 s; rate: three numbers, rad/s, in the "
      "right-handed\n"
      "axes of the gyro, whatever these are. Give samples in the order of their times, those up to an image\n"
      "and the tenth of a second after it before process(). How it sits is found from the motion.");
  odometry.def_property_readonly("gyro", &PyOdometry::gyro,
                                 "How the gyro sits and what is wrong with it, in words; empty without one.");
  odometry.def_property_readonly(
      "is_in_map", &PyOdometry::is_in_map,
      "Whether the newest pose is in the frame and unit of `map`, after the T of the newest event "
      "\"placed\";\n"
      "after a loss or a doubt not until the camera is found there again. From any thread, and in on_event.");
  define(
      odometry, "Odometry.finish()", [](PyOdometry& o, const Arguments&) { return o.finish(); },
      "Ends the run and returns it.");
}

}  // namespace edgevo::python
