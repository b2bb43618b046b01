// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files that grow during a run: the recovery log, trajectory_live_tum.txt and frames.csv. The last two are
// written again, completely, at the end of the run.
#include <string>

#include "edgevo/map/map_log.h"
#include "edgevo/results/recovery_log.h"
#include "growing_file.h"

namespace edgevo {

/// Writes the files that grow during a run.
class LiveFiles {
 public:
  /// `events`: those of the run from its first frame on. Throws InputError if the recovery log cannot be
  /// made.
  LiveFiles(const std::string& folder, const RecoveryHeader& header, MapCursor events);

  /// Appends a frame to the two text files.
  void add(const FrameRecord& frame);
  /// Appends the events so far to the recovery log.
  void write_events();

  /// Whether the recovery log has ended for lack of space.
  bool is_broken() const { return recovery_log_.is_broken(); }

 private:
  RecoveryLog recovery_log_;
  MapCursor events_;
  GrowingFile trajectory_, frames_;
};

}  // namespace edgevo
