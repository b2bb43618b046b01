// SPDX-License-Identifier: BSD-3-Clause
#include "camera_yaml.h"

#include <algorithm>
#include <set>

#include "camera_keys.h"
#include "camera_numbers.h"
#include "camera_region.h"
#include "camera_yaml_lens.h"
#include "edgevo/core/error.h"
#include "edgevo/core/suggestion.h"
#include "lens_text.h"
#include "text_file.h"

namespace edgevo {
namespace {

using Keys = std::vector<std::string>;

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
  if (const std::string remedy = remedy_for_key(key); !remedy.empty())
    throw InputError(where, "unknown key " + quote(key), remedy);
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

void read_size(const YamlValues& values, const std::string& where, Camera* camera) {
  auto size = numbers_of(values, {"resolution"}, where);
  if (size.empty()) {
    size = numbers_of(values, {"image_width", "width"}, where);
    const auto height = numbers_of(values, {"image_height", "height"}, where);
    size.insert(size.end(), height.begin(), height.end());
  }
  if (size.empty()) return;
  if (size.size() != 2) fail_count(where, "the image size", size.size(), "width and height in pixels");
  camera->width = image_side(size[0], where);
  camera->height = image_side(size[1], where);
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

bool is_same(const Camera& a, const Camera& b) {
  const StatedLens lens = stated_lens(a.model), other = stated_lens(b.model);
  return a.pinhole() == b.pinhole() && lens.kind == other.kind && lens.coefficients == other.coefficients;
}

}  // namespace

CameraText camera_of_yaml_values(const YamlValues& values, const std::string& where) {
  refuse_other_settings(values, where);
  check_lens_names(values, where);
  check_keys(values, where);
  CameraText text;
  read_size(values, where, &text.camera);
  text.camera.model = lens_of_yaml(values, where);
  add_notes(values, where, &text);
  apply_region(values, where, &text);
  check_camera_text(text, where);
  return text;
}

// `ros2 topic echo` writes one document for each message; all have the same camera.
CameraText camera_of_yaml_documents(const std::vector<YamlValues>& documents, const std::string& where) {
  if (documents.empty())
    throw InputError(where, "holds no calibration", "give camera_matrix and image_width");
  CameraText first = camera_of_yaml_values(documents.front(), where);
  for (size_t i = 1; i < documents.size(); ++i)
    if (!is_same(camera_of_yaml_values(documents[i], where).camera, first.camera))
      throw InputError(where, "document " + std::to_string(i + 1) + " is another calibration than the first",
                       "keep the one of these images");
  return first;
}

std::optional<CameraMount> parse_yaml_mount(const std::string& text, const std::string& where) {
  const std::vector<YamlValues> documents = parse_yaml_documents(text, where);
  if (documents.empty() || !documents.front().count("mount")) return std::nullopt;
  return camera_mount(yaml_numbers(documents.front(), {"mount"}, where), where + ": mount");
}

}  // namespace edgevo
