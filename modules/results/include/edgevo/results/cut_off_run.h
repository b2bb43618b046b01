#pragma once
// A run that was cut off (killed, no power) is brought to its end with what it had: `edgevo finish`.
//
// Frames keep the poses that they had when they came, moved with the keyframes that have settled since; what
// the last window of keyframes had not settled yet is left out of the map. A requested scale is
// measured again.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// Writes what RunOutputs::finish() would have, into the run's own folder, and takes its journal away.
/// Returns the run. Throws InputError: no run was cut off there, its journal is not readable, a file cannot
/// be written.
Run finish_cut_off_run(const std::string& folder);

}  // namespace edgevo
