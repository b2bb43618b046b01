// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The maps of a finished run at another resolution (`edgevo map`).
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/results/run_maps.h"

namespace edgevo {

/// Throws InputError unless `setting`, GROUP.KEY=VALUE, is a parameter of the maps: one of the odometry would
/// be accepted without any effect.
void check_is_of_maps(const std::string& setting);

/// Throws InputError if `out` is the folder of another run than `run`, or holds other files, unless `force`.
void check_map_folder(const std::string& run, const std::string& out, bool force);

/// The points in the folder of a run; with `include_doubtful` those of its doubtful keyframes, too, which lie
/// in a file of their own. Throws InputError if there is none.
Run read_run_map(const std::string& folder, bool include_doubtful);

/// Voxels and memory that the octree will take, in words.
std::string map_size_text(const Run& run, const MapParams& params);

/// Octree and grid that were written to `out`, a line each.
std::string map_text(const Run& run, const MapReport& report, const std::string& out);

}  // namespace edgevo
