// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Calibration files of other programs. Each dialect is recognised by its content and lists the cameras of the
// file, which are read when one of them is chosen: an unsupported lens of another camera does no harm.
#include <functional>
#include <string>
#include <vector>

#include "camera_forms.h"
#include "camera_yaml.h"
#include "lens_text.h"

namespace edgevo {

/// A camera in a file, under the name by which --sensor chooses it.
struct NamedCamera {
  std::string name;
  std::function<CameraText()> read;
};

using NamedCameras = std::vector<NamedCamera>;

/// A calibration file of another program. All functions throw InputError opened by `where`.
struct Dialect {
  /// Whether the text, which may be binary, is of this kind.
  bool (*is_it)(const std::string& text);
  NamedCameras (*cameras)(const std::string& text, const std::string& where);
};

/// The same for a file in YAML.
struct YamlDialect {
  bool (*is_it)(const YamlValues& values);
  NamedCameras (*cameras)(const YamlValues& values, const std::string& where);
};

/// The dialect of a file; nullptr if it is none of these.
const Dialect* dialect_of(const std::string& text);
const YamlDialect* dialect_of(const YamlValues& values);

/// The camera that `sensor` names, or the only one, whatever its name. Throws InputError that lists the
/// names.
CameraText chosen_camera(const NamedCameras& cameras, const std::string& sensor, const std::string& where);

/// A camera of a lens and a size in pixels, 0 x 0 if the file has none.
CameraText camera_of_lens(StatedLens lens, int width, int height, const std::string& where);

/// Whether `text` begins with `start`.
bool begins_with(const std::string& text, const char* start);

// One file each; the comment at its head says what the format is.
NamedCameras basalt_cameras(const std::string& text, const std::string& where);
bool is_basalt(const std::string& text);
NamedCameras visp_json_cameras(const std::string& text, const std::string& where);
bool is_visp_json(const std::string& text);
NamedCameras colmap_text_cameras(const std::string& text, const std::string& where);
bool is_colmap_text(const std::string& text);
NamedCameras colmap_binary_cameras(const std::string& text, const std::string& where);
bool is_colmap_binary(const std::string& text);
NamedCameras mrpt_ini_cameras(const std::string& text, const std::string& where);
bool is_mrpt_ini(const std::string& text);
NamedCameras xml_cameras(const std::string& text, const std::string& where);
bool is_xml(const std::string& text);
NamedCameras dso_cameras(const std::string& text, const std::string& where);
bool is_dso(const std::string& text);
NamedCameras slam_settings_cameras(const YamlValues& values, const std::string& where);
bool is_slam_settings(const YamlValues& values);
NamedCameras camodocal_cameras(const YamlValues& values, const std::string& where);
bool is_camodocal(const YamlValues& values);
NamedCameras kalibr_cameras(const YamlValues& values, const std::string& where);
bool is_kalibr(const YamlValues& values);

}  // namespace edgevo
