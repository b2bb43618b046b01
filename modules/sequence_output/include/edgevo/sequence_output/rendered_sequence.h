// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rendered scene as a sequence on disk: a folder, a rawlog, or a survey of Symphony Lake (`edgevo
// simulate`).
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera_mount.h"
#include "edgevo/sequence_output/sequence_host.h"
#include "edgevo/simulation/overlay.h"

namespace edgevo {

/// Layouts of surveys, by the names of --layout.
constexpr const char* kSurveys = "symphony_lake";
/// The same with the newer names of files.
constexpr const char* kNewSurveys = "symphony_lake_new";

/// What to render, and what to write of it.
struct RenderRequest {
  /// Name or file of the scene, and its season; empty: its own.
  std::string scene, season;
  /// Folder or OUT.rawlog; for a survey the folder of the archive.
  std::string out;
  /// Camera file of another lens; empty: that of the scene.
  std::string camera_file;
  /// "edgevo", kSurveys or kNewSurveys; name of the survey, empty: a day in the season.
  std::string layout = "edgevo", survey;
  /// Range of frames, begin <= index < end; end -1: to the last.
  int begin = 0, end = -1;
  /// Seed of world and motion; nullopt: that of the scene.
  std::optional<uint64_t> seed;
  /// Read-out and exposure time, seconds; nullopt: those of the scene.
  std::optional<double> rolling_shutter_s, exposure_s;
  /// Mount of the camera; nullopt: that of the camera file or the scene.
  std::optional<CameraMount> mount;
  /// Part that is fixed to the camera; empty kind: none.
  OverlayOptions own_part;
  /// Kind of a gyro (simulation/simulated_gyro.h) whose samples are written next to the images; empty: none.
  std::string gyro;
  /// Kinds of what moves by itself.
  std::vector<std::string> traffic;
  /// Whether to write depth, true edges and the positions of edge pixels in the next frame.
  bool depth = false, edges = false, correspondences = false;
  /// Whether to overwrite existing files.
  bool force = false;
};

/// Renders and writes. Throws InputError for what does not fit the layout, or cannot be written.
void write_rendered(const RenderRequest& request, const SequenceHost& host);

}  // namespace edgevo
