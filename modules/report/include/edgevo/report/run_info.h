// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Description of a run besides its records: command line, source, camera and parameters.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/input_decision.h"

namespace edgevo {

/// Facts about a run that summary.yaml and report.html show besides its records.
struct RunInfo {
  /// Program and arguments.
  std::vector<std::string> command_line;
  /// ImageSource::kind(), and path of the source.
  std::string source_kind, source_path;
  /// Path of the true trajectory, for report.html; empty if there is none.
  std::string ground_truth_path;
  /// Camera as given by the source or --camera.
  Camera camera;
  /// Pinhole that the run works in, if not that of the camera (OdometryOptions::working_pinhole).
  std::optional<Pinhole> working_pinhole;
  /// Effective parameters as written by write_params(), not indented.
  std::string params_yaml;
  /// Whether the run was ended early, by Ctrl-C or a failing source; it is then the part up to there.
  bool interrupted = false;
  /// What the source took its input to be.
  std::vector<InputDecision> input;
  /// The camera as a file for the next run, if it or how a gyro sits was found; empty: neither was.
  std::string camera_file;
  /// What was fixed to the camera at the end of the run: 0 there, 255 elsewhere, size of the raw images;
  /// empty: nothing.
  GrayImage ego_mask;
  /// Further remarks, as name and text.
  std::vector<std::pair<std::string, std::string>> notes;
};

}  // namespace edgevo
