// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// run.mcap: a run as Foxglove, rerun, RViz and ROS 2 read it, written while the run goes (MCAP, profile ros2,
// messages in CDR with their definitions). Whole chunks of two seconds at most go to the system at once: the
// file of a killed program holds all of them, and `edgevo finish` writes the rest. Topics and their meaning:
// share/doc/ros.md.
//
// Frames (REP-103, REP-105): map -> odom -> base_link -> camera_optical_frame. In `odom` poses never jump,
// and drift; map -> odom is rigid, the identity until something is found about the past, and changes with a
// count. Lengths are metres where `is_metric` says so, which holds for the whole file: with a scale that is
// measured on the way, nothing is written until it is known.
//
// Not thread-safe. All functions throw InputError when the file cannot be written.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/occupancy_grid.h"
#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"
#include "edgevo/core/vehicle_track.h"
#include "edgevo/map/map_event.h"
#include "edgevo/scale/scale_params.h"
#include "edgevo/scale/scale_source.h"

namespace edgevo {

struct FrameView;  // tracking/frame_view.h

/// Name of the file in the run's folder.
constexpr const char* kMcapFile = "run.mcap";

/// How much of a run is written.
enum class McapContent {
  /// No file.
  kOff,
  /// All but images: two megabytes a minute at most.
  kPoses,
  /// Five images a second, too, with the edges drawn: ten to thirty megabytes a minute.
  kImages,
};

/// "off", "poses" or "images". Throws InputError, opened by `where`.
McapContent parse_mcap_content(const std::string& text, const std::string& where);

/// What is known of a run before its first frame.
struct McapRun {
  /// Program and version, for the head of the file.
  std::string library;
  /// Pinhole of the rectified images.
  Pinhole pinhole;
  /// Mount of the camera on the vehicle, if known.
  std::optional<SE3> T_vehicle_cam;
  /// Where metres come from.
  ScaleSources scale;
  /// What they are measured by; may be empty.
  VehicleTracks tracks;
  /// Parameters of that.
  ScaleParams scale_params;
  /// The points that are written.
  PointFilter filter;
};

/// Writes the file of one run.
class McapOutput {
 public:
  /// Begins the file; one that is there is overwritten.
  McapOutput(const std::string& path, const McapRun& run);
  ~McapOutput();

  /// Writes what events say: all those of the run, in their order, some at a time.
  void apply(const std::vector<std::shared_ptr<const MapEvent>>& events);
  /// Writes the image of a frame with its edges, unless one was written a fifth of a second ago. Cost: 3 ms
  /// for 1241x376.
  void add_view(Timestamp time, const FrameView& view);
  /// Passes what was written so far to the system, for a run that ends without finish().
  void flush();
  /// Writes what is known at the end, and the index. `grid`: null if there is none. Call once, last.
  void finish(const Run& run, const OccupancyGrid* grid);
  /// What is to be said of the unit of the file, one line; empty where it is that of the run.
  const std::string& note() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
