// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A structured forest of two trees that marks pixels with a strong gradient as edges, to test detectors and
// the checks of models.
#include <opencv2/core.hpp>
#include <string>

#include "forest_model.h"

namespace edgevo::test {

/// Each tree has a root that tests the normalised gradient magnitude at the centre of the patch, a leaf
/// without edges, and a leaf whose centre pixel is an edge.
inline ForestModel tiny_forest() {
  ForestModel m;
  ForestOptions& o = m.options;
  o.stride = 1, o.shrinkNumber = 1, o.patchSize = 8, o.patchInnerSize = 4;
  o.numberOfGradientOrientations = 4, o.gradientNormalizationRadius = 4, o.selfsimilarityGridSize = 2;
  o.numberOfTrees = 2, o.numberOfTreesToEvaluate = 1;
  const int magnitude = 3, side = 8, middle = 4;
  const int feature = magnitude * side * side + middle * side + middle;
  for (int tree = 0; tree < 2; ++tree) {
    m.childs.push_back({2, 0, 0});
    m.featureIds.push_back({feature, 0, 0});
    m.thresholds.push_back({0.8f, 0, 0});
  }
  // Boundaries of six nodes; nodes 2 and 5 have a bin each, which is pixel (2, 2) of the inner patch.
  m.edgeBoundaries = {{0, 0, 0}, {1, 1, 1, 2}};
  m.edgeBins = {{10}, {10}};
  return m;
}

template <class T>
void append_rows(const char* name, const std::vector<std::vector<T>>& rows, std::string* text) {
  *text += std::string(name) + ":\n";
  for (const auto& row : rows) {
    *text += "   - [";
    for (size_t i = 0; i < row.size(); ++i)
      *text += (i == 0 ? " " : ", ") + cv::format("%.9g", double(row[i]));
    *text += " ]\n";
  }
}

/// The model file, as OpenCV reads it.
inline std::string forest_text(const ForestModel& m) {
  const ForestOptions& o = m.options;
  std::string text = "%YAML:1.0\n---\noptions:\n";
  const auto option = [&](const char* name, int value) { text += cv::format("   %s: %d\n", name, value); };
  option("stride", o.stride), option("shrinkNumber", o.shrinkNumber);
  option("patchSize", o.patchSize), option("patchInnerSize", o.patchInnerSize);
  option("numberOfGradientOrientations", o.numberOfGradientOrientations);
  option("gradientSmoothingRadius", o.gradientSmoothingRadius),
      option("regFeatureSmoothingRadius", o.regFeatureSmoothingRadius);
  option("ssFeatureSmoothingRadius", o.ssFeatureSmoothingRadius);
  option("gradientNormalizationRadius", o.gradientNormalizationRadius);
  option("selfsimilarityGridSize", o.selfsimilarityGridSize);
  option("numberOfTrees", o.numberOfTrees), option("numberOfTreesToEvaluate", o.numberOfTreesToEvaluate);
  append_rows("childs", m.childs, &text);
  append_rows("featureIds", m.featureIds, &text);
  append_rows("thresholds", m.thresholds, &text);
  append_rows("edgeBoundaries", m.edgeBoundaries, &text);
  append_rows("edgeBins", m.edgeBins, &text);
  return text;
}

}  // namespace edgevo::test
