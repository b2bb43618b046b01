// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace edgevo {

/// Copies the mask of what a run found to be fixed to the camera from its folder to `out`. Returns false if
/// it found nothing. Throws InputError: no finished run, `out` exists and not `force`, not writable.
bool copy_run_mask(const std::string& run, const std::string& out, bool force);

}  // namespace edgevo
