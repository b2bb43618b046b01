// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes a forest as read by OpenCV's ximgproc (createStructuredEdgeDetection).
#include <string>
#include <vector>

#include "forest_tree.h"

namespace edgevo::training {

/// Writes NAME.yml or NAME.yml.gz: the lists `childs`, `featureIds` and `thresholds` with one row per tree,
/// all of equal length (padded with unreachable leaves); `edgeBins`, the pixels that leaves mark, column by
/// column; `edgeBoundaries`, the first bin of each node, and the end. Throws InputError.
void write_forest(const std::string& path, std::vector<Tree> trees, const ForestShape& shape);

}  // namespace edgevo::training
