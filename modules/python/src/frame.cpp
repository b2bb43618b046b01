// SPDX-License-Identifier: BSD-3-Clause
#include "frame.h"

#include "arrays.h"
#include "classes.h"
#include "edgevo/core/formatted.h"
#include "record.h"

namespace edgevo::python {
namespace {

// A view that keeps the frame alive.
template <class T>
py::array view_of(const PyFrame& f, const std::vector<T>& pixels) {
  using Owner = std::shared_ptr<const Frame>;
  const py::capsule owner(new Owner(f.frame), [](void* p) { delete static_cast<Owner*>(p); });
  const GrayImage& image = f.frame->image;
  return read_only(py::array_t<T>({image.height, image.width}, pixels.data(), owner));
}

py::array image_of(const PyFrame& f) {
  const GrayImage& image = f.frame->image;
  return image.is_deep() ? view_of(f, image.values) : view_of(f, image.pixels);
}

}  // namespace

void add_frame(py::module_& module) {
  py::class_<PyFrame> frame(module, "Frame", "An image of a source, with its time.");
  frame.def_property_readonly(
      "image", image_of,
      "Gray image with lens distortion, H x W, uint8, or uint16 of a camera with more bits.");
  frame.def_property_readonly(
      "time", [](const PyFrame& f) { return f.frame->time.seconds(); }, "Time of exposure, seconds.");
  frame.def_property_readonly(
      "time_ns", [](const PyFrame& f) { return nanoseconds(f.frame->time); },
      "The same in nanoseconds: exact.");
  frame.def_property_readonly(
      "index", [](const PyFrame& f) { return f.frame->index; }, "Position in the source, from 0.");
  frame.def("__repr__", [](const PyFrame& f) {
    return formatted("Frame(%d, time=%s, %d x %d)", f.frame->index, to_string(f.frame->time).c_str(),
                     f.frame->image.width, f.frame->image.height);
  });
}

}  // namespace edgevo::python
