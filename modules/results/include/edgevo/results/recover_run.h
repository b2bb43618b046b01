// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recovery of a run that was interrupted (killed, power failure): `edgevo finish` writes its results from the
// recovery log.
//
// The events on disk are replayed through the code that makes the results of any run (map/run_builder.h), and
// through that of the scale: the results are those of a run that ended there, but for the self-calibration
// that an end makes once more. A keyframe that had not reached the disk is missing, and its frames keep their
// live poses; so are edge lines that were not finished.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// Writes the files that RunOutputs::finish() would have written into the run's own folder and removes the
/// recovery log. Returns the run. Throws InputError: no interrupted run in `folder`, an unreadable recovery
/// log, or a file that cannot be written.
Run recover_run(const std::string& folder);

}  // namespace edgevo
