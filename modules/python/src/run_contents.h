// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A finished run with all that its files need: a Run of C++, how it came about, and the events of its map,
// from which run.mcap is written.
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image_source.h"
#include "edgevo/core/records.h"
#include "edgevo/map/map_log.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/places/place_store.h"
#include "edgevo/report/run_info.h"
#include "edgevo/results/run_params.h"
#include "edgevo/run_loop/kept_places.h"

namespace edgevo::python {

/// A frame as it went by.
struct RecordedFrame {
  /// Its record at that time.
  FrameRecord record;
  /// File of its image; empty if it has none.
  std::string image_path;
  /// What has happened since the frame before, but for the states of the window, which only a run that was
  /// interrupted needs.
  std::vector<std::shared_ptr<const MapEvent>> events;
};

/// Keeps the events of a run, frame by frame. Memory: a copy of the keyframes.
class RunRecorder {
 public:
  /// Follows `log` from now on.
  explicit RunRecorder(std::shared_ptr<MapLog> log) : events_(std::move(log)) {}
  /// Takes what has happened up to this frame.
  void add(const FrameRecord& record, const std::string& image_path);
  /// The frames so far.
  std::vector<RecordedFrame> take_frames() { return std::move(frames_); }
  /// What has happened since the last of them, such as at the end of the run.
  std::vector<std::shared_ptr<const MapEvent>> take_events() { return events_.read(); }

 private:
  MapCursor events_;
  std::vector<RecordedFrame> frames_;
};

/// A finished run.
struct RunContents {
  /// Its results.
  Run run;
  /// Camera of the images.
  Camera camera;
  /// Its description.
  RunInfo info;
  /// Parameters of the maps.
  MapParams map;
  /// Source of the scale, as --scale gives it.
  std::string scale = "none";
  /// What that is measured by; may be empty.
  VehicleTracks tracks;
  /// Frame by frame; empty: not kept.
  std::vector<RecordedFrame> frames;
  /// Its keyframes with their places, for map.db, by id.
  std::map<int, StoredKeyframe> keyframes;
  /// What happened after the last of them.
  std::vector<std::shared_ptr<const MapEvent>> events_at_end;
  /// Folder that it was read from; empty: it was not.
  std::string folder;
};

/// The options that both run() and Odometry have: those of `edgevo run`, with a log of its own.
OdometryOptions odometry_options(const Camera& camera, uint64_t seed);

/// Reads the map of an earlier run for one of this camera; `scale`: as KeptPlaces takes it. Throws
/// InputError.
KeptPlaces read_map_for(const std::string& path, const Camera& camera, const OdometryOptions& options,
                        const std::string& scale);
/// Gives a finished run the unit of the map, and says whether it was found there.
void finish_in_map(const KeptPlaces& map, Run* run, const std::function<void(const std::string&)>& say);

/// What summary.yaml says besides the results.
RunInfo describe_run(const Camera& camera, const RunParams& params, const OdometryOptions& options);

/// Writes the folder of a run: the files of `edgevo run`, with images where they have files of their own.
/// Throws InputError.
void write_run(const RunContents& contents, const std::string& folder);

/// Reads the folder of a run: frames, keyframes with points and lines. Throws InputError.
RunContents read_run(const std::string& folder);

}  // namespace edgevo::python
