// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exporters: each writes one file of a run's folder. To add a file, write a function in a source file of this
// folder, declare it in exporters.h and add a line to the list in exporters.cpp.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/kept_map/map_file_writer.h"
#include "edgevo/mcap_output/mcap_output.h"
#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/occupancy/octree_map.h"
#include "edgevo/report/map_report.h"
#include "edgevo/report/run_info.h"
#include "edgevo/results/run_maps.h"
#include "resource_use.h"

namespace edgevo {

/// Inputs of the exporters, and results that one exporter leaves to those after it.
struct ExportContext {
  /// The run to be written.
  const Run& run;
  /// Parameters of point filter, octree and grid.
  const MapParams& params;
  /// Description of the run. This and the next three are nullptr if only maps are written (`edgevo map`).
  const RunInfo* info = nullptr;
  /// Camera of the raw images.
  const Camera* camera = nullptr;
  /// Writer of the playback, which holds the images.
  const PlaybackWriter* playback = nullptr;
  /// Meter that was started with the run.
  const ResourceMeter* meter = nullptr;
  /// Resources used by the run, before the first file is written.
  ResourceUse use_of_run = {};
  /// The octree, set by the exporter of edges.ot.
  std::optional<OctreeMap> octree = {};
  /// Statistics of the map files.
  MapReport map = {};
  /// Progress callback while the octree is made; may be empty.
  OnKeyframeMapped on_keyframe_mapped = {};
  /// The run with its doubtful keyframes, where `run` lacks their points; else null.
  const Run* with_doubtful = nullptr;
  /// Writer of run.mcap, which holds the run so far; null without one.
  McapOutput* mcap = nullptr;
  /// Writer of map.db, which holds the keyframes so far; null without one.
  MapFileWriter* kept_map = nullptr;
  /// Names of the files that could not be written so far.
  std::vector<std::string> not_written = {};
};

/// Groups of files that are written together.
enum class FileKind {
  /// Text files: small, and the most important ones; disk space is reserved for them.
  kText,
  /// Maps for planners, which `edgevo map` can write again.
  kMap,
  /// Files for the tools of MRPT and ROS.
  kMrpt,
  /// The report page.
  kReport,
  /// The summary, written last because it lists what is missing.
  kSummary
};

/// A file of a run and the function that writes it.
struct Exporter {
  /// File name.
  const char* file;
  /// Content of the file, one line for people.
  const char* content;
  /// Group of the file.
  FileKind kind;
  /// Writes the file. May throw anything: the other files are written all the same. nullptr: written together
  /// with another file.
  void (*write)(ExportContext* context, const std::string& path);
  /// Whether the run has content for this file; nullptr: always.
  bool (*applies)(const ExportContext& context) = nullptr;
};

/// All exporters, in the order of writing.
const std::vector<Exporter>& exporters();

}  // namespace edgevo
