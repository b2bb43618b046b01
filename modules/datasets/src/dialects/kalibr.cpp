// SPDX-License-Identifier: BSD-3-Clause
// Kalibr's camchain: a group cam0, cam1, ... for each camera, with camera_model, intrinsics,
// distortion_model, distortion_coeffs and resolution. The lenses are read as in every calibration in YAML
// (camera_yaml_lens.h).
#include <set>

#include "dialect.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

// "cam1" of a key "cam1.resolution"; empty for other keys.
std::string camera_name_of(const std::string& key) {
  const size_t dot = key.find('.');
  if (dot == std::string::npos || dot < 4 || key.rfind("cam", 0) != 0) return {};
  const bool is_numbered = key.find_first_not_of("0123456789", 3) == dot;
  return is_numbered ? key.substr(0, dot) : std::string();
}

std::set<std::string> camera_names(const YamlValues& values) {
  std::set<std::string> names;
  for (const auto& [key, value] : values) names.insert(camera_name_of(key));
  names.erase("");
  return names;
}

// The keys of one camera, and those that belong to none.
YamlValues keys_of(const YamlValues& values, const std::string& camera) {
  YamlValues result;
  for (const auto& [key, value] : values) {
    const std::string name = camera_name_of(key);
    if (name == camera) result[key.substr(name.size() + 1)] = value;
    if (name.empty()) result[key] = value;
  }
  return result;
}

}  // namespace

bool is_kalibr(const YamlValues& values) { return !camera_names(values).empty(); }

NamedCameras kalibr_cameras(const YamlValues& values, const std::string& where) {
  NamedCameras cameras;
  for (const std::string& name : camera_names(values))
    cameras.push_back(
        {name, [values = keys_of(values, name), where] { return camera_of_yaml_values(values, where); }});
  return cameras;
}

}  // namespace edgevo
