// SPDX-License-Identifier: BSD-3-Clause
// Basalt's calibration.json: value0.intrinsics lists each camera's type and named parameters,
// value0.resolution its size. The cameras have no names; they are cam0, cam1, ... as in its other files.
#include <nlohmann/json.hpp>

#include "camera_numbers.h"
#include "dialect.h"
#include "edgevo/core/error.h"
#include "edgevo/core/suggestion.h"
#include "shallow_json.h"
#include "text_file.h"

namespace edgevo {
namespace {

using Json = nlohmann::json;

struct BasaltType {
  const char* name;
  LensKind kind;
  std::vector<std::string> coefficients;
};

const std::vector<BasaltType>& types() {
  static const std::vector<BasaltType> all{
      {"pinhole", LensKind::kPinhole, {}},
      {"ds", LensKind::kDoubleSphere, {"xi", "alpha"}},
      {"eucm", LensKind::kExtendedUnified, {"alpha", "beta"}},
      {"ucm", LensKind::kUnified, {"alpha"}},
      {"kb4", LensKind::kKannalaBrandt, {"k1", "k2", "k3", "k4"}},
      {"fov", LensKind::kFov, {"w"}},
      {"pinhole-radtan8", LensKind::kRational, {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}}};
  return all;
}

[[noreturn]] void basalt_fail(const std::string& where, const std::string& what) {
  throw InputError(where, what, "restore Basalt's calibration.json");
}

double number(const Json& parent, const std::string& key, const std::string& where) {
  const auto it = parent.find(key);
  if (it == parent.end()) basalt_fail(where, "has no " + quote(key));
  if (!it->is_number()) basalt_fail(where, quote(key) + " is not a number");
  return it->get<double>();
}

const BasaltType& type_of(const Json& camera, const std::string& where) {
  const auto it = camera.find("camera_type");
  const std::string name = it != camera.end() && it->is_string() ? it->get<std::string>() : std::string();
  std::vector<std::string> known;
  for (const BasaltType& type : types()) {
    if (name == type.name) return type;
    known.emplace_back(type.name);
  }
  const std::string suggestion = did_you_mean(name, known);
  throw InputError(where, "Basalt's camera_type " + quote(name) + " is not supported",
                   suggestion.empty() ? "calibrate as kb4, ds or eucm" : suggestion);
}

// Basalt's parameters in the order of StatedLens.
CameraText read_camera(const Json& camera, const Json& size, const std::string& where) {
  if (!camera.is_object()) basalt_fail(where, "a camera is not an object");
  const BasaltType& type = type_of(camera, where);
  const auto values = camera.find("intrinsics");
  if (values == camera.end() || !values->is_object()) basalt_fail(where, "a camera has no 'intrinsics'");
  StatedLens lens;
  lens.kind = type.kind;
  lens.intrinsics = {number(*values, "fx", where), number(*values, "fy", where), number(*values, "cx", where),
                     number(*values, "cy", where)};
  for (const std::string& key : type.coefficients) lens.coefficients.push_back(number(*values, key, where));
  if (!size.is_array() || size.size() != 2 || !size[0].is_number() || !size[1].is_number())
    basalt_fail(where, "'resolution' is not width and height");
  return camera_of_lens(std::move(lens), image_side(size[0].get<double>(), where),
                        image_side(size[1].get<double>(), where), where);
}

}  // namespace

bool is_basalt(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{' && text.find('"') != std::string::npos;
}

NamedCameras basalt_cameras(const std::string& text, const std::string& where) {
  const Json file = parse_shallow_json(text);
  if (file.is_discarded()) basalt_fail(where, "is not complete JSON");
  const Json value = file.value("value0", Json());
  const Json intrinsics = value.is_object() ? value.value("intrinsics", Json()) : Json();
  const Json sizes = value.is_object() ? value.value("resolution", Json()) : Json();
  if (!intrinsics.is_array())
    throw InputError(where, "is JSON, but no calibration of Basalt: it has no value0.intrinsics",
                     kWriteNumbers);
  if (!sizes.is_array() || sizes.size() != intrinsics.size())
    basalt_fail(where, "'resolution' does not list as many sizes as there are cameras");
  NamedCameras cameras;
  for (size_t i = 0; i < intrinsics.size(); ++i) {
    const std::string name = "cam" + std::to_string(i);
    cameras.push_back({name, [camera = intrinsics[i], size = sizes[i], where, name] {
                         return read_camera(camera, size, where + ", " + name);
                       }});
  }
  return cameras;
}

}  // namespace edgevo
