// SPDX-License-Identifier: BSD-3-Clause
// A class of the user as a source: its camera, and what its __next__ returns.
#include <utility>

#include "edgevo/core/error.h"
#include "frame.h"
#include "gyro_input.h"
#include "image_input.h"
#include "source.h"

namespace edgevo::python {
namespace {

Camera user_camera(const py::object& source) {
  const py::object camera = source.attr("camera");
  if (!py::isinstance<Camera>(camera))
    throw py::type_error("Source.camera is " + describe(camera) + "; a Camera is wanted");
  return py::cast<Camera>(camera);
}

class UserSource : public ImageSource {
 public:
  UserSource(py::object source, std::function<void(const std::string&)> say)
      : source_(std::move(source)), say_(std::move(say)), camera_(user_camera(source_)), images_(camera_) {
    if (py::hasattr(source_, "__len__")) size_ = int(py::len(source_));
    const py::object gyro = py::getattr(source_, "gyro", py::none());
    if (!gyro.is_none()) gyro_ = gyro_samples(gyro, "Source.gyro");
  }

  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return size_; }
  std::string kind() const override { return "Python"; }
  GyroReadings gyro_readings() const override { return gyro_; }
  std::optional<Frame> next() override;

 private:
  Frame frame_of(const py::object& item);

  py::object source_;
  std::function<void(const std::string&)> say_;
  Camera camera_;
  ImageInput images_;
  GyroReadings gyro_;  // from the first sample on, since each copy reads by itself
  std::optional<int> size_;
  int next_index_ = 0;
};

std::optional<Frame> UserSource::next() {
  const py::gil_scoped_acquire gil;
  py::object item;
  try {
    item = source_.attr("__next__")();
  } catch (py::error_already_set& e) {
    if (!e.matches(PyExc_StopIteration)) throw;
    return std::nullopt;
  }
  Frame frame = frame_of(item);
  frame.index = next_index_++;
  for (const std::string& line : images_.take_notes()) say_(line);
  return frame;
}

Frame UserSource::frame_of(const py::object& item) {
  const std::string where = "Source.__next__()";
  if (py::isinstance<PyFrame>(item)) return *py::cast<PyFrame>(item).frame;
  if (!py::isinstance<py::tuple>(item) || py::len(item) != 2)
    throw py::type_error(where + " returned " + describe(item) + "; (image, time) or a Frame is wanted");
  const auto pair = py::reinterpret_borrow<py::tuple>(item);
  Frame frame;
  images_.read(pair[0], where + ": image", &frame.image);
  frame.time = time_of(pair[1], where + ": time");
  return frame;
}

}  // namespace

std::unique_ptr<ImageSource> frames_of(py::object user_source, std::function<void(const std::string&)> say) {
  return std::make_unique<UserSource>(std::move(user_source), std::move(say));
}

}  // namespace edgevo::python
