#pragma once
// What one file of a run's folder is made by. To add a file: a function in a source file of this folder,
// declared in exporters.h, and a line in the list of exporters.cpp.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/occupancy/octree_map.h"
#include "edgevo/report/map_report.h"
#include "edgevo/report/run_info.h"
#include "edgevo/results/run_maps.h"
#include "resource_use.h"

namespace edgevo {

/// What the files are made from, and what the making of one leaves to those after it.
struct ExportContext {
  const Run& run;
  const MapParams& params;  ///< which points count, voxels, cells
  // nullptr where a finished run's maps are made again (`edgevo map`):
  const RunInfo* info = nullptr;
  const Camera* camera = nullptr;             ///< of the images as they come
  const PlaybackWriter* playback = nullptr;   ///< has the images
  const ResourceMeter* meter = nullptr;       ///< began with the run
  ResourceUse use_of_run = {};                ///< before the first of these files
  std::optional<OctreeMap> octree = {};       ///< since edges.ot was tried
  MapReport map = {};                         ///< what the map files hold
  OnKeyframeMapped on_keyframe_mapped = {};   ///< told while the octree is made; may be empty
  std::vector<std::string> not_written = {};  ///< files that could not be, so far
};

enum class FileKind {
  kText,    ///< small, and missed most: room is held for them
  kMap,     ///< of the map for planners: `edgevo map` writes them again
  kMrpt,    ///< for MRPT's tools
  kReport,  ///< for people
  kSummary  ///< the last: tells of all others
};

struct Exporter {
  const char* file;
  const char* content;
  FileKind kind;
  /// Throws what it likes: the others are written all the same. nullptr: comes with another file.
  void (*write)(ExportContext* context, const std::string& path);
  /// Whether there is anything to write; nullptr: always.
  bool (*applies)(const ExportContext& context) = nullptr;
};

/// All, in the order in which they are written.
const std::vector<Exporter>& exporters();

}  // namespace edgevo
