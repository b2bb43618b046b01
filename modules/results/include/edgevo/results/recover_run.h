// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recovery of a run that was interrupted (killed, power failure): `edgevo finish` writes its results from the
// recovery log.
//
// The events on disk are replayed through the code that makes the results of any run (map/run_builder.h), and
// through that of the scale: the results are those of a run that ended there, but for the self-calibration
// that an end makes once more. A keyframe that had not reached the disk is missing, and its frames keep their
// live poses; so are edge lines that were not finished.
#include <optional>
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/mcap_output/mcap_output.h"

namespace edgevo {

/// What a recovery log gave.
struct RecoveredRun {
  /// The run, as far as it was recovered.
  Run run;
  /// Number of frames that the log holds beyond the place where it is damaged.
  int frames_lost = 0;
  /// Whether the log is damaged, and not merely cut off; it is then kept.
  bool is_damaged = false;
  /// RunOutputs::map_note().
  std::string map_note;
  /// RunOutputs::mcap_note().
  std::string mcap_note;
};

/// How the results are written.
struct RecoveryOptions {
  /// As in OutputOptions.
  bool include_doubtful = false;
  /// Size of the voxels and cells of the maps, in the unit of the run; nothing: that of the run.
  std::optional<double> resolution;
  /// Whether run.mcap is written, without images; nothing: if the interrupted run has begun one that has
  /// none.
  std::optional<McapContent> mcap;
};

/// Writes the files that RunOutputs::finish() would have written into the run's own folder and removes the
/// recovery log, unless it is damaged. Throws InputError: no interrupted run in `folder`, an unreadable
/// recovery log, or a file that cannot be written, which includes a map that the resolution cannot hold.
RecoveredRun recover_run(const std::string& folder, const RecoveryOptions& options = {});

}  // namespace edgevo
