#pragma once
// Octrees as files that octomap's readers open, with comments of ours: its own writers print to stderr.
#include <octomap/AbstractOcTree.h>

#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// First lines of an .ot file, and of a .bt file.
constexpr const char* kOtFirstLine = "# Octomap OcTree file";
constexpr const char* kBtFirstLine = "# Octomap OcTree binary file";

/// Axes and unit of a run's map, as comments.
std::string octree_comments(const Run& run);

/// The header that octomap would write; `comments` are whole lines that begin with #.
std::string octree_header(const char* first_line, const std::string& comments,
                          const octomap::AbstractOcTree& tree);

}  // namespace edgevo
