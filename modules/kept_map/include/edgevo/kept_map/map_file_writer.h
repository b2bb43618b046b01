// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes the map that a run keeps (map.db) while it goes on: keyframe by keyframe, so that a run that is
// killed leaves what it had; and once more at its end, with the final poses.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/kept_map/kept_map.h"
#include "edgevo/map/map_event.h"

namespace edgevo {

/// Name of the file in the folder of a run.
constexpr const char* kMapFile = "map.db";
/// The names of all files that a run may leave of it.
const std::vector<std::string>& map_file_names();

/// Writes one file. For one thread at a time.
class MapFileWriter {
 public:
  /// Makes the file, in place of what is there. Throws InputError, as all below: a disk that is full.
  MapFileWriter(const std::string& path, const MapHeader& header);
  /// Opens the file of a run that was killed, to be finished.
  explicit MapFileWriter(const std::string& path);
  ~MapFileWriter();
  MapFileWriter(const MapFileWriter&) = delete;
  MapFileWriter& operator=(const MapFileWriter&) = delete;

  /// Appends a keyframe, or replaces the one of this id; removes one that is doubtful or has no view. It
  /// survives the death of the program from then on. Cost: 1 ms at 1241x376.
  void add(const StoredKeyframe& keyframe);
  /// Appends what relates two keyframes, or nothing if it relates others.
  void add(const ConstraintAdded& added);
  /// Removes it.
  void withdraw(int constraint);

  /// Writes the file anew: with the final poses and points of `run` and its unit, without keyframes and
  /// constraints that it does not have or trust, the same bytes for the same run. The old file stays until
  /// the new one is complete. Nothing may be added afterwards. Cost: 0.3 ms a keyframe.
  void finish(const Run& run);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
