// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/kept_map/kept_map.h"

namespace edgevo {

/// Writes a finished map, in place of what is there: the old file stays until the new one is complete,
/// whenever the program is killed. All keyframes have a view. Throws InputError: a disk that is full. Cost:
/// 1 ms a keyframe.
void write_map(const KeptMap& map, const std::string& path);

}  // namespace edgevo
