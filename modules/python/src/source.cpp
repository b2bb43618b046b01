// SPDX-License-Identifier: BSD-3-Clause
#include "source.h"

#include <utility>

#include "classes.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/describe.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/simulation/folder_export.h"
#include "frame.h"

namespace edgevo::python {
namespace {

constexpr double kMaxFps = 1e5;

std::unique_ptr<PySource> of_user(const Arguments& a) {
  auto source = std::make_unique<PySource>();
  if (!a.has("camera")) return source;
  if (!py::isinstance<Camera>(a.at("camera"))) a.refuse("camera", "a Camera");
  source->camera = py::reinterpret_borrow<py::object>(a.at("camera"));
  return source;
}

py::object camera_of(const PySource& s) {
  if (s.source) return py::cast(s.source->camera());
  if (!s.camera)
    throw py::attribute_error("Source.camera is not set; call super().__init__(camera), or set it");
  return s.camera;
}

void set_camera(PySource& s, const py::object& camera) {
  if (s.source) throw py::attribute_error("Source.camera is that of the source and cannot be set");
  if (!py::isinstance<Camera>(camera))
    throw py::type_error("Source.camera is to be " + describe(camera) + "; a Camera is wanted");
  s.camera = camera;
}

PyFrame next_frame(PySource& s) {
  if (!s.source) {
    PyErr_SetString(PyExc_NotImplementedError,
                    "Source.__next__() is not defined; return (image, time), or raise StopIteration");
    throw py::error_already_set();
  }
  const InUse::Call call(s.in_use, "Source.__next__()");
  std::optional<Frame> frame;
  {
    const py::gil_scoped_release released;
    frame = s.source->next();
  }
  if (!frame) throw py::stop_iteration();
  return {std::make_shared<const Frame>(std::move(*frame))};
}

py::object size_of(const PySource& s) {
  if (!s.source || !s.source->size()) return py::none();
  return py::int_(*s.source->size());
}

py::tuple notes_of(const PySource& s) {
  py::list lines;
  if (s.source)
    for (const std::string& line : opening_lines(s.options.path, *s.source)) lines.append(line);
  return py::tuple(lines);
}

std::string kind_of(const PySource& s) { return s.source ? s.source->kind() : "Python"; }

std::unique_ptr<PySource> open_source_of(const Arguments& a) {
  SourceOptions options;
  options.path = a.path("path");
  if (a.has("topic")) options.topic = a.text("topic");
  if (a.has("camera")) options.camera_file = a.path("camera");
  if (a.has("gyro")) options.gyro = a.path("gyro");
  if (a.has("frames")) std::tie(options.first, options.last) = a.range("frames");
  options.fps = a.number("fps", 0);
  if (options.fps < 0 || options.fps > kMaxFps)
    throw bad_value(a.where("fps"), "is " + describe(a.at("fps")), "give frames per second, above 0");
  return open(options);
}

std::unique_ptr<PySource> simulate(const Arguments& a) {
  auto source = std::make_unique<PySource>();
  const std::string scene = source->options.path = a.path("scene");
  std::optional<uint64_t> seed;
  if (a.has("seed")) seed = a.seed("seed", 0);
  std::pair<int, std::optional<int>> frames{0, std::nullopt};
  if (a.has("frames")) frames = a.range("frames");
  const py::gil_scoped_release released;
  source->renderer = std::make_shared<const SceneRenderer>(load_scene(scene, seed));
  source->first = frames.first, source->end = frames.second.value_or(source->renderer->size());
  source->source = std::make_unique<RenderedSource>(source->renderer, source->first, source->end);
  return source;
}

}  // namespace

std::unique_ptr<PySource> open(const SourceOptions& options) {
  auto source = std::make_unique<PySource>();
  source->options = options;
  const py::gil_scoped_release released;
  source->source = open_source(options);
  return source;
}

Trajectory true_trajectory(const PySource& s) {
  if (s.renderer) return parse_trajectory(ground_truth_tum(*s.renderer, s.first, s.end), "simulate()");
  const std::string where = s.source ? s.options.path : "Source";
  if (!s.source) throw InputError(where, "knows no true trajectory", "give a file, or times and poses");
  if (const std::string path = s.source->ground_truth_path(); !path.empty()) return read_trajectory(path);
  const std::string text = ground_truth_tum(s.options, *s.source);
  if (text.empty()) throw InputError(where, "holds no ground truth", "give a trajectory file");
  return parse_trajectory(text, where);
}

void add_source(py::module_& module) {
  py::class_<PySource> source(
      module, "Source", py::dynamic_attr(),
      "Frames of one camera in the order of their times; can be iterated once.\n\n"
      "As a base class for a camera of your own: give it its Camera, and define __next__() to return\n"
      "(image, time) or a Frame, and to raise StopIteration at the end.\n"
      "Its attribute `gyro`, if it has one, holds (time, rate) of a gyro next to the camera, rad/s.");
  define_init(source, "Source(camera=None)", of_user);
  source.def_property("camera", camera_of, set_camera, "The Camera of the images.");
  source.def_property_readonly("size", size_of, "Number of frames; None if it is not known beforehand.");
  source.def_property_readonly("kind", kind_of, "Kind of the source, such as \"KITTI odometry\".");
  source.def_property_readonly("notes", notes_of,
                               "What was decided about the input and what is doubtful, a str each.");
  source.def("__iter__", [](py::object self) { return self; });
  source.def("__next__", next_frame);
  define_function(
      module, "open_source(path, topic=None, *, camera=None, gyro=None, frames=None, fps=None)",
      open_source_of,
      "Opens a recording (bag of ROS, rawlog), a folder of a data set or of images, a video or "
      "\"camera:0\".\n\n"
      "topic: that of the images in a bag, by default the only one; camera: path of a calibration file;\n"
      "gyro: path of the samples of a gyro, or \"off\", by default that of the recording;\n"
      "frames: (first, end); fps: frames per second of images without times.");
  define_function(module, "simulate(scene, seed=None, *, frames=None)", simulate,
                  "Renders a scene, by its name (\"street\") or YAML file, with exact ground truth.\n\n"
                  "seed: of world and motion, by default that of the scene; frames: (first, end).");
}

}  // namespace edgevo::python
