// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/camera.h"

#include "arguments.h"
#include "arrays.h"
#include "classes.h"
#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/output_file.h"
#include "edgevo/datasets/camera_file.h"

namespace edgevo::python {
namespace {

constexpr int kMaxSide = 65535;  // pixels
constexpr const char* kInit = "Camera(model, width, height, fx, fy, cx, cy, d=())";
constexpr const char* kModels =
    "pinhole, radtan (plumb_bob), rational, equidistant (kannala_brandt), fov, ucm, eucm, double_sphere or "
    "omni";

std::vector<double> coefficients(const Arguments& a) {
  if (!a.has("d")) return {};
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  if (py::isinstance<py::str>(a.at("d"))) a.refuse("d", "a list of numbers");
  const auto array = Numbers::ensure(a.at("d"));
  if (!array || array.ndim() > 1) {
    PyErr_Clear();
    a.refuse("d", "a list of numbers");
  }
  return {array.data(), array.data() + array.size()};
}

std::string listed(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + formatted("%.17g", number);
  return "[" + text + "]";
}

std::string calibration_text(const Arguments& a, const std::string& model) {
  std::vector<double> d = coefficients(a);
  if (model == "pinhole" && !d.empty())
    throw bad_value("Camera(): d", "has coefficients, but a pinhole has none", "name the model of the lens");
  if (model == "pinhole") d.assign(4, 0);
  return formatted("image_width: %d\nimage_height: %d\n", a.integer("width", 1, kMaxSide),
                   a.integer("height", 1, kMaxSide)) +
         "distortion_model: " + (model == "pinhole" ? "plumb_bob" : model) +
         "\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: " +
         listed({a.number("fx"), 0, a.number("cx"), 0, a.number("fy"), a.number("cy"), 0, 0, 1}) +
         "\ndistortion_coefficients: " + listed(d) + "\n";
}

Camera make_camera(const Arguments& a) {
  const std::string model = a.text("model");
  if (model.empty() || model.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789") != std::string::npos)
    throw bad_value("Camera(): model", "is " + describe(a.at("model")), std::string("give ") + kModels);
  return parse_camera(calibration_text(a, model), "Camera()");
}

py::tuple coefficients_of_camera(const Camera& camera) {
  py::list values;
  for (const auto& [name, value] : coefficients_of(camera.model)) values.append(value);
  return py::tuple(values);
}

py::array matrix_of(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  Eigen::Matrix3d K;
  K << p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1;
  return to_array(Eigen::MatrixXd(K));
}

std::string camera_in_words(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  return formatted("Camera(%s, %d x %d, fx=%g, fy=%g, cx=%g, cy=%g)", to_string(camera.model), camera.width,
                   camera.height, p.fx, p.fy, p.cx, p.cy);
}

}  // namespace

void add_camera(py::module_& module) {
  py::class_<Camera> camera(
      module, "Camera",
      "The camera that takes the images. Pixels; (0, 0) is the centre of the top-left pixel.\n\n"
      "model: pinhole, radtan, rational, equidistant, fov, ucm, eucm, double_sphere or omni; d: its\n"
      "coefficients in the order of OpenCV and Kalibr. Focal lengths as the formula of the model has them.");
  define_init(camera, kInit, make_camera);
  camera.def_property_readonly(
      "model", [](const Camera& c) { return to_string(c.model); }, "Name of the model.");
  camera.def_readonly("width", &Camera::width, "Pixels.");
  camera.def_readonly("height", &Camera::height, "Pixels.");
  camera.def_property_readonly("K", matrix_of,
                               "Focal lengths on the axis and principal point, 3 x 3, pixels.");
  camera.def_property_readonly("d", coefficients_of_camera, "Coefficients of the lens; empty for a pinhole.");
  camera.def("__repr__", camera_in_words);
  define(
      camera, "Camera.save(path)",
      [](const Camera& c, const Arguments& a) { write_file(a.path("path"), camera_yaml(c, "")); },
      "Writes a calibration file that ROS, OpenCV and read_camera() read.");
  define_function(
      module, "read_camera(path, sensor=None)",
      [](const Arguments& a) {
        const std::string path = a.path("path"), sensor = a.has("sensor") ? a.text("sensor") : "";
        const py::gil_scoped_release released;
        return read_camera_file(path, sensor);
      },
      "Reads a calibration file: of ROS, OpenCV, Kalibr, ORB-SLAM, COLMAP, DSO, MRPT and others.\n\n"
      "sensor: name of the camera in a file of several.");
}

}  // namespace edgevo::python
