// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Octree files for octomap's readers, with comments. octomap's own writers print to stderr.
#include <octomap/AbstractOcTree.h>

#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// First lines of .ot and .bt files.
constexpr const char* kOtFirstLine = "# Octomap OcTree file";
constexpr const char* kBtFirstLine = "# Octomap OcTree binary file";

/// Comment lines with axes and unit of a run's map.
std::string octree_comments(const Run& run);

/// The header that octomap would write, with `comments`: complete lines that begin with #.
std::string octree_header(const char* first_line, const std::string& comments,
                          const octomap::AbstractOcTree& tree);

}  // namespace edgevo
