// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A structured forest as read by OpenCV's ximgproc (StructuredEdgeDetection), validated first: OpenCV checks
// nothing, and reads outside its arrays or loops forever if a file is malformed.
#include <string>
#include <vector>

namespace edgevo {

/// Options of a forest, named as in the file.
struct ForestOptions {
  /// Distance of patches, pixels.
  int stride = 0;
  /// Image pixels per feature pixel, in each direction.
  int shrinkNumber = 0;
  /// Sides of the patch that is read, and of its centre that is predicted, pixels.
  int patchSize = 0, patchInnerSize = 0;
  int numberOfGradientOrientations = 0;
  /// Smoothing radii, pixels.
  int gradientSmoothingRadius = 0, regFeatureSmoothingRadius = 0, ssFeatureSmoothingRadius = 0;
  int gradientNormalizationRadius = 0;
  /// Cells per side of the self-similarity grid.
  int selfsimilarityGridSize = 0;
  int numberOfTrees = 0, numberOfTreesToEvaluate = 0;

  /// Number of feature channels.
  int channels() const { return 2 * (numberOfGradientOrientations + 1) + 3; }
};

/// Contents of the file, one row per tree. A node with child 0 is a leaf; one with child c has the nodes c -
/// 1 and c of the tree as children.
struct ForestModel {
  ForestOptions options;
  std::vector<std::vector<int>> childs, featureIds;
  std::vector<std::vector<float>> thresholds;
  /// First bin of each node, counted over all trees, and the end.
  std::vector<std::vector<int>> edgeBoundaries;
  /// Pixels of the inner patch (times channels) that a leaf marks.
  std::vector<std::vector<int>> edgeBins;
};

/// Throws InputError, prefixed by `where`, unless every walk through the forest ends and stays inside the
/// arrays: options present and in range; childs, featureIds and thresholds of equal length in every tree;
/// children after their parent and inside the tree; feature ids in range; thresholds finite; edgeBoundaries
/// ascending, one more than nodes, up to the number of edgeBins; edgeBins in range.
void validate_forest(const ForestModel& model, const std::string& where);

/// Parses the text of a forest file without validation. Throws InputError for another file format and for a
/// part that is missing or of another type.
ForestModel parse_forest(const std::string& text, const std::string& where);
/// Reads and validates a file (.yml or .yml.gz), with the reader that OpenCV's detector uses.
ForestModel read_forest(const std::string& path);

}  // namespace edgevo
