// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two maps as one.
#include <string>
#include <vector>

#include "edgevo/kept_map/kept_map.h"
#include "edgevo/kept_map/map_alignment.h"

namespace edgevo {

/// Keyframes and constraints of both maps in the frame and unit of `a`, and the places that relate them.
/// Keyframes, segments and epochs of `b` are numbered after those of `a`.
KeptMap join_maps(const KeptMap& a, const KeptMap& b, const MapAlignment& alignment);

/// What join_map_files() found, in one line, and what was damaged in the two maps, a line each.
struct JoinedMaps {
  /// The line.
  std::string statement;
  /// The others; what could be read was joined.
  std::vector<std::string> warnings;
};
/// Joins two map files (as map_file_of()) and writes the result, a new file. Throws InputError, and writes
/// nothing: twice the same map, fewer than three places agree, a map that cannot be read or is not finished,
/// another camera, `out` is there.
JoinedMaps join_map_files(const std::string& a, const std::string& b, const std::string& out);

}  // namespace edgevo
