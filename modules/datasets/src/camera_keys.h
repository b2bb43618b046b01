// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The keys of calibrations in YAML, in lower case: those that make the camera, those that do not concern it,
// and those that are accepted with their default only.
#include <set>
#include <string>
#include <vector>

#include "camera_yaml.h"

namespace edgevo {

/// A key that changes the camera in a way that is not read: only its default is accepted.
struct CameraKeyWithDefault {
  std::string key;
  std::set<std::string> defaults;
  /// What another value means and what to do, for messages.
  std::string meaning, remedy;
};

/// The key of `keys` that the file has, with or without ROS's and OpenCV's `data` below it; empty if none.
/// Throws InputError for two of them, which would contradict one another.
std::string only_key(const YamlValues& values, const std::vector<std::string>& keys,
                     const std::string& where);

/// The numbers under that key; empty if there is none. Throws InputError for a key without a value.
std::vector<double> numbers_of(const YamlValues& values, const std::vector<std::string>& keys,
                               const std::string& where);

/// Throws InputError: `key` holds `found` numbers, and `expected` is what to write.
[[noreturn]] void fail_count(const std::string& where, const std::string& key, size_t found,
                             const std::string& expected);

/// Names of the 3x3 matrix, and of the distortion.
const std::vector<std::string>& camera_matrix_keys();
const std::vector<std::string>& distortion_keys();
/// All keys that make the camera; those of matrices may have rows, cols, dt, type_id and data below them.
const std::vector<std::string>& used_camera_keys();
/// Keys, and groups of keys, without influence on the camera.
const std::vector<std::string>& ignored_camera_keys();
/// The same in a stereo calibration of OpenCV.
const std::vector<std::string>& ignored_stereo_keys();
const std::vector<CameraKeyWithDefault>& camera_keys_with_default();
/// How to write what an unknown key seems to mean: a single focal length, coefficient or part of the mount.
/// Empty: nothing known.
std::string remedy_for_key(const std::string& key);

/// Throws InputError if the keys are those of another program's settings, which are not read.
void refuse_other_settings(const YamlValues& values, const std::string& where);

}  // namespace edgevo
