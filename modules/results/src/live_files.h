// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files that grow during a run: the recovery log, trajectory_live_tum.txt and frames.csv. The last two are
// written again, completely, at the end of the run.
#include <string>

#include "edgevo/odometry/odometry.h"
#include "edgevo/results/recovery_log.h"
#include "growing_file.h"

namespace edgevo {

/// Writes the files that grow during a run.
class LiveFiles {
 public:
  /// Throws InputError if the recovery log cannot be made.
  LiveFiles(const std::string& folder, const RecoveryHeader& header);

  /// Appends a frame, the keyframes marginalised by then and those of the window.
  void add(const FrameRecord& frame, const Odometry& odometry);

  /// Whether the recovery log has ended for lack of space.
  bool is_broken() const { return recovery_log_.is_broken(); }

 private:
  void add_marginalised(const Odometry& odometry);

  RecoveryLog recovery_log_;
  GrowingFile trajectory_, frames_;
};

}  // namespace edgevo
