#pragma once
// A structured forest as OpenCV's ximgproc reads it (StructuredEdgeDetection), validated before OpenCV sees
// it: OpenCV checks nothing, and walks out of its arrays, or for ever, where a file is not what it should be.
#include <string>
#include <vector>

namespace edgevo {

/// The names are those of the file.
struct ForestOptions {
  int stride = 0;                         ///< pixels from patch to patch
  int shrinkNumber = 0;                   ///< image pixels a feature pixel
  int patchSize = 0, patchInnerSize = 0;  ///< pixels: what is looked at, and its middle, which is predicted
  int numberOfGradientOrientations = 0;
  int gradientSmoothingRadius = 0, regFeatureSmoothingRadius = 0, ssFeatureSmoothingRadius = 0;  ///< pixels
  int gradientNormalizationRadius = 0;
  int selfsimilarityGridSize = 0;  ///< cells a side
  int numberOfTrees = 0, numberOfTreesToEvaluate = 0;

  /// Channels of features, and of OpenCV's output.
  int channels() const { return 2 * (numberOfGradientOrientations + 1) + 3; }
};

/// Rows as in the file, a tree a row. Child 0: a leaf; child c: the nodes c - 1 and c of the tree.
struct ForestModel {
  ForestOptions options;
  std::vector<std::vector<int>> childs, featureIds;
  std::vector<std::vector<float>> thresholds;
  std::vector<std::vector<int>>
      edgeBoundaries;  ///< where the bins of a node begin, all trees in one count, and the end
  std::vector<std::vector<int>> edgeBins;  ///< pixels of the inner patch (times channels) that a leaf marks
};

/// Throws InputError, opened by `where`, unless every index that a walk through the forest can take stays
/// inside its array and every walk ends: options present and sane; childs, featureIds and thresholds of one
/// length in every tree; children behind their parent and inside the tree; feature ids in range; thresholds
/// finite; edgeBoundaries ascending, one more than nodes, up to the number of edgeBins; edgeBins in range.
void validate_forest(const ForestModel& model, const std::string& where);

/// From the text of such a file, not validated. Throws InputError: no such file format, a part missing or of
/// another type.
ForestModel parse_forest(const std::string& text, const std::string& where);
/// From a file (.yml or .yml.gz), by the reader that OpenCV's detector uses; validated.
ForestModel read_forest(const std::string& path);

}  // namespace edgevo
