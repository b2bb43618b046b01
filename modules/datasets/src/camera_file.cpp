// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/camera_file.h"

#include <cmath>

#include "camera_forms.h"
#include "camera_numbers.h"
#include "camera_yaml.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

bool is_yaml(const std::string& text, const std::string& where) {
  for (const TextLine& line : split_lines(text, where))
    if (line.text.find(':') != std::string::npos || line.text[0] == '%') return true;
  return false;
}

}  // namespace

int image_side(double value, const std::string& where) {
  if (!(value >= 1 && value <= kLargestSide) || value != std::floor(value))
    throw InputError(
        where, "the image size is not a whole number of pixels from 1 to " + std::to_string(kLargestSide),
        "give width and height in pixels");
  return int(value);
}

CameraText parse_camera_text(const std::string& text, const std::string& where) {
  refuse_other_forms(text, where);
  CameraText result =
      is_yaml(text, where) ? parse_camera_yaml(text, where) : parse_camera_numbers(text, where);
  check_camera_text(result, where);
  return result;
}

Camera parse_camera(const std::string& text, const std::string& where) {
  const CameraText result = parse_camera_text(text, where);
  if (!result.has_size())
    throw InputError(where, "the image size is missing", "give image_width and image_height in pixels");
  return result.camera;
}

Camera read_camera_file(const std::string& path) { return parse_camera(read_text_file(path), path); }

std::optional<CameraMount> read_camera_mount(const std::string& path) {
  const std::string text = read_text_file(path);
  return is_yaml(text, path) ? parse_yaml_mount(text, path) : std::nullopt;
}

}  // namespace edgevo
