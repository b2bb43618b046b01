// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of YAML that calibration files use: maps by indentation or in braces, lists in brackets, scalars.
// A full parser would accept much more than a calibration, and MRPT's prints to stderr.
#include <map>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"

namespace edgevo {

/// Values by dotted key in lower case (one value for a scalar, several for a list).
using YamlValues = std::map<std::string, std::vector<std::string>>;

/// Parses YAML into dotted keys. Tags (!!opencv-matrix), directives and block lists ("- x") are skipped.
/// Throws InputError opened by `where`.
YamlValues parse_flat_yaml(const std::string& text, const std::string& where);

/// Numbers under the first of `keys` that exists; empty if none does. Throws InputError for a value that is
/// not a number.
std::vector<double> yaml_numbers(const YamlValues& values, const std::vector<std::string>& keys,
                                 const std::string& where);

/// Parses a calibration in YAML. Throws InputError.
Camera parse_camera_yaml(const std::string& text, const std::string& where);

}  // namespace edgevo
