// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of YAML that calibration files use: maps by indentation or in braces, lists in brackets or by
// dashes, scalars. A full parser would accept much more than a calibration, and MRPT's prints to stderr.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "camera_forms.h"
#include "edgevo/core/camera_mount.h"
#include "edgevo/gyro/gyro_model.h"

namespace edgevo {

/// What is given under a key: a scalar is a list of one, and lists of lists are joined.
struct YamlValue {
  std::vector<std::string> texts;
  /// Line of the key, from 1.
  int line = 0;
  /// False for `key:` with nothing below it.
  bool is_given = true;
};

/// Values by dotted key in lower case.
using YamlValues = std::map<std::string, YamlValue>;

/// Parses YAML into dotted keys, one map for each document that is not empty. Tags (!!opencv-matrix) and
/// directives are skipped. Throws InputError opened by `where`.
std::vector<YamlValues> parse_yaml_documents(const std::string& text, const std::string& where);

/// The same for text of one document. Throws InputError if there are several.
YamlValues parse_flat_yaml(const std::string& text, const std::string& where);

/// Numbers under the first of `keys` that exists; empty if none does. Throws InputError for a value that is
/// not a number.
std::vector<double> yaml_numbers(const YamlValues& values, const std::vector<std::string>& keys,
                                 const std::string& where);

/// A calibration of ROS, OpenCV, EuRoC, edgevo or one camera of Kalibr by its keys. Throws InputError.
CameraText camera_of_yaml_values(const YamlValues& values, const std::string& where);

/// The same of documents that all have the same camera. Throws InputError.
CameraText camera_of_yaml_documents(const std::vector<YamlValues>& documents, const std::string& where);

/// The mount in a calibration in YAML; nullopt if it has none. Throws InputError.
std::optional<CameraMount> parse_yaml_mount(const std::string& text, const std::string& where);

/// The gyro in a calibration in YAML; nullopt if it has none. Throws InputError.
std::optional<GyroModel> parse_yaml_gyro(const std::string& text, const std::string& where);

}  // namespace edgevo
