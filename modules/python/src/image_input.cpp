// SPDX-License-Identifier: BSD-3-Clause
#include "image_input.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/intensities.h"

namespace edgevo::python {
namespace {

enum class Kind { kGray, kColour, kDeep };

std::string shape_text(int height, int width) {
  return std::to_string(height) + " x " + std::to_string(width);
}

// Nothing for a type or a number of axes that no image has.
std::optional<Kind> kind_of(const py::array& array) {
  const bool has_uint8 = py::isinstance<py::array_t<uint8_t>>(array);
  const bool has_uint16 = py::isinstance<py::array_t<uint16_t>>(array);
  if (array.ndim() == 2 && has_uint8) return Kind::kGray;
  if (array.ndim() == 2 && has_uint16) return Kind::kDeep;
  if (array.ndim() == 3 && array.shape(2) == 3 && has_uint8) return Kind::kColour;
  return std::nullopt;
}

const char* name_of(Kind kind) {
  constexpr const char* kNames[] = {"uint8 H x W", "uint8 H x W x 3", "uint16 H x W"};
  return kNames[int(kind)];
}

const uint8_t* bytes_of(const py::array& array) { return static_cast<const uint8_t*>(array.data()); }

}  // namespace

void ImageInput::check(py::handle object, const std::string& where) const {
  const std::string size = shape_text(height_, width_);
  const std::string wanted = "an array of uint8, " + size + " (also " + size + " x 3, or uint16), is wanted";
  if (!py::isinstance<py::array>(object))
    throw py::type_error(where + " is " + describe(object) + "; " + wanted);
  const auto array = py::reinterpret_borrow<py::array>(object);
  const bool has_type =
      py::isinstance<py::array_t<uint8_t>>(array) || py::isinstance<py::array_t<uint16_t>>(array);
  if (!has_type) throw py::type_error(where + " is " + describe(object) + "; " + wanted);
  if (!kind_of(array) || array.shape(0) != height_ || array.shape(1) != width_)
    throw bad_value(where, "is " + describe(object), wanted);
  if (!(array.flags() & py::array::c_style))
    throw bad_value(where, "is " + describe(object) + " whose rows are not one after another in memory",
                    "give numpy.ascontiguousarray(image)");
}

void ImageInput::read(py::handle object, const std::string& where, GrayImage* image) {
  check(object, where);
  const auto array = py::reinterpret_borrow<py::array>(object);
  const Kind kind = *kind_of(array);
  if (!kind_.empty() && kind_ != name_of(kind))
    throw bad_value(where, "is " + describe(object), "the images before it were " + kind_);
  image->width = width_, image->height = height_;
  if (kind == Kind::kGray) read_gray(array, image);
  if (kind == Kind::kColour) read_colour(array, image);
  if (kind == Kind::kDeep) read_deep(array, image);
  if (kind_.empty() && kind == Kind::kColour)
    notes_.push_back("images: uint8 H x W x 3 is taken as blue, green, red and converted to gray");
  kind_ = name_of(kind);
}

void ImageInput::read_gray(const py::array& array, GrayImage* image) const {
  image->pixels.assign(bytes_of(array), bytes_of(array) + array.size());
}

void ImageInput::read_colour(const py::array& array, GrayImage* image) const {
  image->pixels.resize(size_t(width_) * size_t(height_));
  const cv::Mat colour(height_, width_, CV_8UC3, const_cast<uint8_t*>(bytes_of(array)));
  cv::cvtColor(colour, cv::Mat(height_, width_, CV_8UC1, image->pixels.data()), cv::COLOR_BGR2GRAY);
}

void ImageInput::read_deep(const py::array& array, GrayImage* image) {
  const auto* const values = static_cast<const uint16_t*>(array.data());
  DeepImage deep{width_, height_, {values, values + array.size()}};
  if (!scale_) {
    IntensityCount count;
    count.add(deep);
    const Intensities found = decide_intensities(count, 0, "the first image");
    scale_ = found.scale;
    if (found.decision) notes_.push_back(to_string(*found.decision));
  }
  *image = with_pixels(std::move(deep), *scale_);
}

std::vector<std::string> ImageInput::take_notes() { return std::exchange(notes_, {}); }

}  // namespace edgevo::python
