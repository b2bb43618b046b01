// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/camera_file.h"

#include <cmath>

#include "camera_numbers.h"
#include "camera_yaml.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

// Format of camera.txt, for messages.
constexpr const char* kNumbersFormat = "fx fy cx cy k1 k2 p1 p2 width height [k3]";

Camera parse_camera_numbers(const std::string& text, const std::string& where) {
  const auto lines = split_lines(text, where);
  if (lines.empty()) throw InputError(where, "holds no calibration", std::string("write ") + kNumbersFormat);
  if (lines.size() > 1) throw InputError(lines[1].where, "a second calibration follows", "keep one line");
  const size_t count = split_fields(lines[0].text).size() == 11 ? 11 : 10;
  const auto v = parse_numbers(lines[0], count, kNumbersFormat);
  Camera camera;
  camera.set_pinhole(
      {v[0], v[1], v[2], v[3], image_side(v[8], lines[0].where), image_side(v[9], lines[0].where)});
  camera.set_distortion({v[4], v[5], v[6], v[7], count == 11 ? v[10] : 0.0});
  camera.check(where);
  return camera;
}

}  // namespace

int image_side(double value, const std::string& where) {
  if (!(value >= 1 && value <= kLargestSide) || value != std::floor(value))
    throw InputError(
        where, "the image size is not a whole number of pixels from 1 to " + std::to_string(kLargestSide),
        "give width and height in pixels");
  return int(value);
}

Camera parse_camera(const std::string& text, const std::string& where) {
  for (const TextLine& line : split_lines(text, where))
    if (line.text.find(':') != std::string::npos || line.text[0] == '%')
      return parse_camera_yaml(text, where);
  return parse_camera_numbers(text, where);
}

Camera read_camera_file(const std::string& path) { return parse_camera(read_text_file(path), path); }

}  // namespace edgevo
