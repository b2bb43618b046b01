#pragma once
// The part of YAML that calibration files use: maps by indentation or in braces, lists in brackets, scalars.
// A full parser would accept much more than a calibration is, and MRPT's prints to stderr.
#include <map>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"

namespace edgevo {

/// Dotted key in lower case -> values (one for a scalar, several for a list).
using YamlValues = std::map<std::string, std::vector<std::string>>;

/// Throws InputError opened by `where`. Tags (!!opencv-matrix), directives and block lists ("- x") are passed
/// over.
YamlValues parse_flat_yaml(const std::string& text, const std::string& where);

/// The numbers under the first of `keys` that is there; empty if none is. Throws InputError for what is not a
/// number.
std::vector<double> yaml_numbers(const YamlValues& values, const std::vector<std::string>& keys,
                                 const std::string& where);

/// Throws InputError.
Camera parse_camera_yaml(const std::string& text, const std::string& where);

}  // namespace edgevo
