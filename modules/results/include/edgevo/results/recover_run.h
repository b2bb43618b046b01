// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recovery of a run that was interrupted (killed, power failure): `edgevo finish` writes its results from the
// recovery log.
//
// Frames keep their live poses, corrected by how far their keyframes have moved since. Edge lines are lost,
// as are keyframes of the window that had not reached the disk. A requested scale is measured again.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// Writes the files that RunOutputs::finish() would have written into the run's own folder and removes the
/// recovery log. Returns the run. Throws InputError: no interrupted run in `folder`, an unreadable recovery
/// log, or a file that cannot be written.
Run recover_run(const std::string& folder);

}  // namespace edgevo
