// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The recovery log: the events of a run (map/map_event.h) on disk while it runs, so that a killed program
// loses none of its results.
//
// `unfinished_run.bin` in the run's folder holds a header and each event in its order. Every record has a
// checksum, so the file may end anywhere. It is removed once the run's files are written. The bytes are
// specific to this machine and this version of the program. Cost: about 700 bytes a frame and 40 bytes a map
// point; 24 bytes a point again whenever the camera is corrected. The keyframes that are still in the window
// are in `unfinished_window.bin`, which is replaced as a whole after each keyframe, once the events before it
// are on disk.
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "edgevo/core/vehicle_track.h"
#include "edgevo/map/map_event.h"
#include "edgevo/report/run_info.h"

namespace edgevo {

/// Name of the file with the keyframes of the window.
constexpr const char* kRunWindow = "unfinished_window.bin";
/// Name of the note in RunInfo::notes of a run that ends unfinished (RunOutputs::end_unfinished()).
constexpr const char* kForgottenNote = "forgotten";
/// Note in RunInfo::notes of a run whose run.mcap has images.
constexpr const char* kMcapNote = "run_mcap";
/// Text of that note.
constexpr const char* kMcapWithImages = "with images";
/// Name of the recovery log in the run's folder.
constexpr const char* kRecoveryLog = "unfinished_run.bin";

/// Everything known before the first frame that is needed to write a run's files.
struct RecoveryHeader {
  /// Description of the run, as in the run's files.
  RunInfo info;
  /// Sources of the scale, in the syntax of --scale.
  std::string scale = "none";
  /// Vehicle tracks that the scale is measured by; may be empty.
  VehicleTracks tracks;
  /// Mount of the camera on the vehicle, if known.
  std::optional<SE3> T_vehicle_cam;
};

/// Writes the recovery log of one run. For use by one thread.
class RecoveryLog {
 public:
  /// Begins `folder`/unfinished_run.bin and removes the window of another run. Throws InputError if it cannot
  /// be made.
  RecoveryLog(const std::string& folder, const RecoveryHeader& header);
  ~RecoveryLog();

  /// Appends events in their order; of those that describe the window, the newest replaces the stored window.
  /// On a full disk the log ends and is removed; the run goes on.
  void add(const std::vector<std::shared_ptr<const MapEvent>>& events);

  /// Whether the log ended before the run, for lack of space.
  bool is_broken() const;
  /// Removes the log, once the run's files are written.
  void remove();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads the recovery log of an interrupted run, as far as it is whole.
class RecoveryLogReader {
 public:
  /// Opens the log in `folder`. Throws InputError: no such file, its run is still in progress, or a header
  /// that is incomplete or of another version.
  explicit RecoveryLogReader(const std::string& folder);
  ~RecoveryLogReader();

  /// Header written before the first frame.
  const RecoveryHeader& header() const;
  /// The next event; nothing after the last one that is complete. The stored window comes last.
  std::optional<MapEvent> next();
  /// Once next() has returned nothing: indices of the frames recorded beyond the place where the log is
  /// damaged; empty if it was merely cut off. They cannot be used, since what they build on is missing.
  std::set<int> frames_beyond_damage();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
