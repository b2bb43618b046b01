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

/// Throws InputError if the keys are those of another program's settings, which are not read.
void refuse_other_settings(const YamlValues& values, const std::string& where);

}  // namespace edgevo
