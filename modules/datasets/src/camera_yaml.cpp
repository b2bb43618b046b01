// SPDX-License-Identifier: BSD-3-Clause
#include "camera_yaml.h"

#include <set>

#include "camera_numbers.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

[[noreturn]] void fail_count(const std::string& where, const std::string& key, size_t found,
                             const std::string& expected) {
  throw InputError(where, key + " holds " + std::to_string(found) + " numbers", "write " + expected);
}

void read_size(const YamlValues& values, const std::string& where, Pinhole* p) {
  auto size = yaml_numbers(values, {"resolution"}, where);
  if (size.empty()) {
    size = yaml_numbers(values, {"image_width", "width"}, where);
    const auto height = yaml_numbers(values, {"image_height", "height"}, where);
    size.insert(size.end(), height.begin(), height.end());
  }
  if (size.empty())
    throw InputError(where, "the image size is missing", "give image_width and image_height in pixels");
  if (size.size() != 2) fail_count(where, "the image size", size.size(), "width and height in pixels");
  p->width = image_side(size[0], where);
  p->height = image_side(size[1], where);
}

void read_matrix(const YamlValues& values, const std::string& where, Pinhole* p) {
  const auto four = yaml_numbers(values, {"intrinsics"}, where);
  if (four.size() == 4) {
    p->fx = four[0], p->fy = four[1], p->cx = four[2], p->cy = four[3];
    return;
  }
  if (!four.empty()) fail_count(where, "intrinsics", four.size(), "fx, fy, cx, cy");
  const auto m = yaml_numbers(values, {"camera_matrix.data", "camera_matrix", "k"}, where);
  if (m.empty()) throw InputError(where, "camera_matrix is missing", "give it as 3x3 numbers, row by row");
  if (m.size() != 9) fail_count(where, "camera_matrix", m.size(), "3x3 numbers, row by row");
  if (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
    throw InputError(where, "camera_matrix is not [fx 0 cx, 0 fy cy, 0 0 1]", "calibrate without skew");
  p->fx = m[0], p->fy = m[4], p->cx = m[2], p->cy = m[5];
}

void check_model(const YamlValues& values, const std::string& where) {
  static const std::set<std::string> known = {"plumb_bob",      "radtan", "radial-tangential",
                                              "pinhole-radtan", "none",   ""};
  for (const auto& [key, allowed] :
       {std::pair("distortion_model", known), std::pair("camera_model", std::set<std::string>{"pinhole"})}) {
    const auto it = values.find(key);
    if (it == values.end() || it->second.empty()) continue;
    if (!allowed.count(it->second.front()))
      throw InputError(where, std::string(key) + " " + quote(it->second.front()) + " is not supported",
                       "use a pinhole camera with plumb_bob, or undistort the images beforehand");
  }
}

void read_distortion(const YamlValues& values, const std::string& where, Distortion* d) {
  auto k = yaml_numbers(
      values, {"distortion_coefficients.data", "distortion_coefficients", "distortion_coeffs", "d"}, where);
  while (k.size() > 5 && k.back() == 0) k.pop_back();  // the rational model with its denominator at 1
  if (k.size() > 5) fail_count(where, "distortion_coefficients", k.size(), "k1, k2, p1, p2, k3");
  if (!k.empty() && k.size() < 4)
    fail_count(where, "distortion_coefficients", k.size(), "k1, k2, p1, p2, k3");
  k.resize(5, 0.0);
  *d = {k[0], k[1], k[2], k[3], k[4]};
}

// Kalibr groups each camera under its own name: cam0, cam1, ...
YamlValues without_camera_name(const YamlValues& values, const std::string& where) {
  YamlValues result;
  for (const auto& [key, value] : values) {
    if (key.rfind("cam1.", 0) == 0)
      throw InputError(where, "several cameras", "keep the one that took the images");
    result[key.rfind("cam0.", 0) == 0 ? key.substr(5) : key] = value;
  }
  return result;
}

}  // namespace

Camera parse_camera_yaml(const std::string& text, const std::string& where) {
  const YamlValues values = without_camera_name(parse_flat_yaml(text, where), where);
  Pinhole pinhole;
  Distortion distortion;
  read_size(values, where, &pinhole);
  read_matrix(values, where, &pinhole);
  check_model(values, where);
  read_distortion(values, where, &distortion);
  const Camera camera(pinhole, distortion);
  camera.check(where);
  return camera;
}

}  // namespace edgevo
