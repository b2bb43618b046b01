// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images from arrays of numpy. An array is read during the call and never kept: it may be overwritten then.
#include <pybind11/numpy.h>

#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"

namespace edgevo::python {

/// Reads the images of one sequence: uint8 H x W, uint8 H x W x 3 (blue, green, red, as OpenCV has them) or
/// uint16 H x W, in C order. All have the kind of the first.
class ImageInput {
 public:
  /// `camera`: whose size they have; needed during the calls only.
  explicit ImageInput(const Camera& camera) : width_(camera.width), height_(camera.height) {}

  /// Fills `image`. Throws TypeError for anything but an array of these types, InputError for another shape
  /// or order, in a line that names what came and what is wanted. Needs the GIL. Cost: a copy.
  void read(py::handle array, const std::string& where, GrayImage* image);
  /// What was decided since the last call, a line each: that images are converted or scaled.
  std::vector<std::string> take_notes();

 private:
  void read_gray(const py::array& array, GrayImage* image) const;
  void read_colour(const py::array& array, GrayImage* image) const;
  void read_deep(const py::array& array, GrayImage* image);
  void check(py::handle object, const std::string& where) const;

  int width_, height_;
  std::string kind_;
  std::optional<IntensityScale> scale_;
  std::vector<std::string> notes_;
};

}  // namespace edgevo::python
