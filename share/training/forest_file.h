#pragma once
// A forest as OpenCV's ximgproc reads it (createStructuredEdgeDetection).
#include <string>
#include <vector>

#include "forest_tree.h"

namespace edgevo::training {

/// Writes NAME.yml or NAME.yml.gz: the lists `childs`, `featureIds` and `thresholds`, a row for each tree,
/// all of one length (leaves nobody reaches fill the shorter ones); `edgeBins`, the pixels that leaves mark,
/// column by column; `edgeBoundaries`, where a node's begin, and the end. Throws InputError.
void write_forest(const std::string& path, std::vector<Tree> trees, const ForestShape& shape);

}  // namespace edgevo::training
