// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A run without the points and lines of its doubtful keyframes (KeyframeRecord::is_doubtful), and the rest.
#include "edgevo/core/records.h"

namespace edgevo {

/// The run with the points and lines of the keyframes that are not doubtful; frames and keyframes stay.
Run trusted_part(const Run& run);
/// The run with the points and lines of the doubtful keyframes only.
Run doubtful_part(const Run& run);

}  // namespace edgevo
