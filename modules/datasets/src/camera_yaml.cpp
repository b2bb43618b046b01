// SPDX-License-Identifier: BSD-3-Clause
#include "camera_yaml.h"

#include <algorithm>
#include <set>

#include "camera_keys.h"
#include "camera_numbers.h"
#include "edgevo/core/error.h"
#include "edgevo/core/suggestion.h"
#include "text_file.h"

namespace edgevo {
namespace {

using Keys = std::vector<std::string>;

[[noreturn]] void fail_count(const std::string& where, const std::string& key, size_t found,
                             const std::string& expected) {
  throw InputError(where, key + " holds " + std::to_string(found) + " numbers", "write " + expected);
}

// The key of `keys` that the file has, with or without ROS's and OpenCV's `data` below it; empty if none.
// Two of them would contradict one another.
std::string only_key(const YamlValues& values, const Keys& keys, const std::string& where) {
  std::string found;
  for (const std::string& name : keys)
    for (const std::string& key : {name, name + ".data"}) {
      if (!values.count(key)) continue;
      if (!found.empty())
        throw InputError(where, quote(found) + " and " + quote(key) + " mean the same", "keep one");
      found = key;
    }
  return found;
}

std::vector<double> numbers_of(const YamlValues& values, const Keys& keys, const std::string& where) {
  const std::string key = only_key(values, keys, where);
  if (key.empty()) return {};
  const YamlValue& value = values.at(key);
  if (!value.is_given)
    throw InputError(where + ", line " + std::to_string(value.line), quote(key) + " has no value",
                     "write its numbers, or leave the key out");
  return yaml_numbers(values, {key}, where);
}

// ---- keys ----

bool is_below(const std::string& key, const std::string& group) {
  return key == group || key.rfind(group + ".", 0) == 0;
}

bool is_one_of(const std::string& key, const Keys& groups) {
  return std::any_of(groups.begin(), groups.end(), [&](const auto& group) { return is_below(key, group); });
}

bool is_matrix_part(const std::string& key) {
  const size_t dot = key.rfind('.');
  if (dot == std::string::npos) return false;
  static const std::set<std::string> parts{"rows", "cols", "dt", "data", "type_id"};
  return parts.count(key.substr(dot + 1)) && is_one_of(key.substr(0, dot), used_camera_keys());
}

const CameraKeyWithDefault* key_with_default(const std::string& key) {
  const auto& all = camera_keys_with_default();
  const auto it = std::find_if(all.begin(), all.end(), [&](const auto& k) { return key == k.key; });
  return it == all.end() ? nullptr : &*it;
}

void check_key(const std::string& key, const YamlValue& value, bool is_stereo, const std::string& file) {
  const std::string where = file + ", line " + std::to_string(value.line);
  if (const CameraKeyWithDefault* known = key_with_default(key)) {
    for (const std::string& text : value.texts)
      if (!known->defaults.count(text))
        throw InputError(where, key + " " + quote(text) + ": " + known->meaning, known->remedy);
    return;
  }
  const Keys& used = used_camera_keys();
  if (std::count(used.begin(), used.end(), key) || is_matrix_part(key)) return;
  if (is_one_of(key, ignored_camera_keys()) || (is_stereo && is_one_of(key, ignored_stereo_keys()))) return;
  Keys known = used;
  known.insert(known.end(), ignored_camera_keys().begin(), ignored_camera_keys().end());
  for (const auto& k : camera_keys_with_default()) known.push_back(k.key);
  const std::string suggestion = did_you_mean(key, known);
  throw InputError(where, "unknown key " + quote(key),
                   suggestion.empty() ? "remove it if it does not belong to the camera" : suggestion);
}

void check_keys(const YamlValues& values, const std::string& where) {
  const bool is_stereo = !only_key(values, {"m1"}, where).empty();
  for (const auto& [key, value] : values) check_key(key, value, is_stereo, where);
}

// ---- values ----

void read_size(const YamlValues& values, const std::string& where, Pinhole* p) {
  auto size = numbers_of(values, {"resolution"}, where);
  if (size.empty()) {
    size = numbers_of(values, {"image_width", "width"}, where);
    const auto height = numbers_of(values, {"image_height", "height"}, where);
    size.insert(size.end(), height.begin(), height.end());
  }
  if (size.empty()) return;
  if (size.size() != 2) fail_count(where, "the image size", size.size(), "width and height in pixels");
  p->width = image_side(size[0], where);
  p->height = image_side(size[1], where);
}

void read_matrix(const YamlValues& values, const std::string& where, Pinhole* p) {
  Keys either = camera_matrix_keys();
  either.push_back("intrinsics");
  if (only_key(values, either, where) == "intrinsics") {
    const auto four = numbers_of(values, {"intrinsics"}, where);
    if (four.size() != 4) fail_count(where, "intrinsics", four.size(), "fx, fy, cx, cy");
    p->fx = four[0], p->fy = four[1], p->cx = four[2], p->cy = four[3];
    return;
  }
  const auto m = numbers_of(values, camera_matrix_keys(), where);
  if (m.empty())
    throw InputError(where, "camera_matrix is missing (Kalibr: intrinsics)",
                     "give it as 3x3 numbers, row by row");
  if (m.size() != 9) fail_count(where, "camera_matrix", m.size(), "3x3 numbers, row by row");
  if (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
    throw InputError(where, "camera_matrix is not [fx 0 cx, 0 fy cy, 0 0 1]", "calibrate without skew");
  p->fx = m[0], p->fy = m[4], p->cx = m[2], p->cy = m[5];
}

void check_model(const YamlValues& values, const std::string& where) {
  static const Keys lenses{"plumb_bob",      "radtan", "radial-tangential",
                           "pinhole-radtan", "none",   "rational_polynomial"};
  for (const auto& [key, allowed] :
       {std::pair("distortion_model", lenses), std::pair("camera_model", Keys{"pinhole"})}) {
    const auto it = values.find(key);
    if (it == values.end() || it->second.texts.empty() || it->second.texts.front().empty()) continue;
    const std::string& name = it->second.texts.front();
    if (std::count(allowed.begin(), allowed.end(), name)) continue;
    const std::string suggestion = did_you_mean(name, allowed);
    throw InputError(where, std::string(key) + " " + quote(name) + " is not supported",
                     suggestion.empty()
                         ? "use a pinhole camera with plumb_bob, or undistort the images beforehand"
                         : suggestion);
  }
}

void read_distortion(const YamlValues& values, const std::string& where, Distortion* d) {
  auto k = numbers_of(values, distortion_keys(), where);
  while (k.size() > 5 && k.back() == 0) k.pop_back();  // the rational model with its denominator at 1
  if (k.size() > 5) fail_count(where, "distortion_coefficients", k.size(), "k1, k2, p1, p2, k3");
  if (!k.empty() && k.size() < 4)
    fail_count(where, "distortion_coefficients", k.size(), "k1, k2, p1, p2, k3");
  k.resize(5, 0.0);
  *d = {k[0], k[1], k[2], k[3], k[4]};
}

// A rotation that ROS's rectification_matrix states: zeros (unset) and the identity are none.
bool is_turned_by_rectification(const YamlValues& values, const std::string& where) {
  const auto r = numbers_of(values, {"rectification_matrix", "r"}, where);
  for (size_t i = 0; i < r.size(); ++i)
    if (r[i] != 0 && (r[i] != 1 || i % 4 != 0)) return true;
  return false;
}

void add_notes(const YamlValues& values, const std::string& where, CameraText* text) {
  if (!only_key(values, {"m1"}, where).empty()) {
    text->note = "M1 and D1, the first camera of a stereo pair";
    if (!only_key(values, {"m2"}, where).empty())
      text->doubt =
          "It is wrong for images of the second camera: for those, write M2 and D2 as camera_matrix and "
          "distortion_coefficients into a file of their own.";
  } else if (is_turned_by_rectification(values, where)) {
    text->note =
        "for raw images, since the file has a rectification_matrix; rectified ones (image_rect) have the "
        "camera of its projection_matrix";
  }
}

// ---- documents ----

// Kalibr groups each camera under its own name: cam0, cam1, ...
std::string camera_name_of(const std::string& key) {
  const size_t dot = key.find('.');
  if (dot == std::string::npos || dot < 4 || key.rfind("cam", 0) != 0) return {};
  const bool is_numbered = key.find_first_not_of("0123456789", 3) == dot;
  return is_numbered ? key.substr(0, dot) : std::string();
}

YamlValues without_camera_name(const YamlValues& values, const std::string& where) {
  YamlValues result;
  std::set<std::string> names;
  for (const auto& [key, value] : values) {
    const std::string name = camera_name_of(key);
    if (!name.empty()) names.insert(name);
    if (names.size() > 1) throw InputError(where, "several cameras", "keep the one that took the images");
    result[name.empty() ? key : key.substr(name.size() + 1)] = value;
  }
  return result;
}

CameraText camera_of(const YamlValues& document, const std::string& where) {
  const YamlValues values = without_camera_name(document, where);
  refuse_other_settings(values, where);
  check_model(values, where);
  check_keys(values, where);
  Pinhole pinhole;
  Distortion distortion;
  read_size(values, where, &pinhole);
  read_matrix(values, where, &pinhole);
  read_distortion(values, where, &distortion);
  CameraText text;
  text.camera = Camera(pinhole, distortion);
  add_notes(values, where, &text);
  check_camera_text(text, where);
  return text;
}

bool is_same(const Camera& a, const Camera& b) {
  const Distortion d = a.distortion(), e = b.distortion();
  return a.pinhole() == b.pinhole() && d.k1 == e.k1 && d.k2 == e.k2 && d.p1 == e.p1 && d.p2 == e.p2 &&
         d.k3 == e.k3;
}

}  // namespace

// `ros2 topic echo` writes one document for each message; all have the same camera.
CameraText parse_camera_yaml(const std::string& text, const std::string& where) {
  const std::vector<YamlValues> documents = parse_yaml_documents(text, where);
  if (documents.empty())
    throw InputError(where, "holds no calibration", "give camera_matrix and image_width");
  const CameraText first = camera_of(documents.front(), where);
  for (size_t i = 1; i < documents.size(); ++i)
    if (!is_same(camera_of(documents[i], where).camera, first.camera))
      throw InputError(where, "document " + std::to_string(i + 1) + " is another calibration than the first",
                       "keep the one of these images");
  return first;
}

std::optional<CameraMount> parse_yaml_mount(const std::string& text, const std::string& where) {
  const std::vector<YamlValues> documents = parse_yaml_documents(text, where);
  if (documents.empty()) return std::nullopt;
  const YamlValues values = without_camera_name(documents.front(), where);
  if (!values.count("mount")) return std::nullopt;
  return camera_mount(yaml_numbers(values, {"mount"}, where), where + ": mount");
}

}  // namespace edgevo
