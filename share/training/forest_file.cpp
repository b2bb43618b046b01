// SPDX-License-Identifier: BSD-3-Clause
#include "forest_file.h"

#include <algorithm>
#include <opencv2/core/persistence.hpp>

#include "edgevo/core/error.h"

namespace edgevo::training {
namespace {

void make_equally_long(std::vector<Tree>* trees) {
  size_t nodes = 0;
  for (const Tree& t : *trees) nodes = std::max(nodes, t.childs.size());
  for (Tree& t : *trees)
    t.childs.resize(nodes), t.feature_ids.resize(nodes), t.thresholds.resize(nodes), t.answers.resize(nodes);
}

void write_options(cv::FileStorage& file, const ForestShape& s) {
  file << "options"
       << "{"
       << "stride" << s.stride << "shrinkNumber" << s.shrink << "patchSize" << s.patch << "patchInnerSize"
       << s.inner << "numberOfGradientOrientations" << s.orientations << "gradientSmoothingRadius"
       << s.gradient_smoothing << "regFeatureSmoothingRadius" << s.regular_smoothing
       << "ssFeatureSmoothingRadius" << s.similarity_smoothing << "gradientNormalizationRadius"
       << s.gradient_normalisation << "selfsimilarityGridSize" << s.grid << "numberOfTrees" << s.trees
       << "numberOfTreesToEvaluate" << s.trees_evaluated << "}";
}

template <class Part>
void write_rows(cv::FileStorage& file, const char* name, const std::vector<Tree>& trees, Part part) {
  file << name << "[";
  for (const Tree& t : trees) file << part(t);
  file << "]";
}

void write_answers(cv::FileStorage& file, const std::vector<Tree>& trees) {
  std::vector<std::vector<int>> bins, boundaries;
  int count = 0;
  for (const Tree& t : trees) {
    bins.emplace_back(), boundaries.emplace_back();
    for (const EdgePatch& answer : t.answers) {
      boundaries.back().push_back(count);
      for (int u = 0; u < kInner; ++u)
        for (int v = 0; v < kInner; ++v)
          if (answer[size_t(v * kInner + u)]) bins.back().push_back(u * kInner + v), ++count;
    }
  }
  boundaries.back().push_back(count);
  for (const auto& [name, rows] :
       {std::make_pair("edgeBoundaries", &boundaries), std::make_pair("edgeBins", &bins)}) {
    file << name << "[";
    for (const auto& row : *rows) file << row;
    file << "]";
  }
}

}  // namespace

void write_forest(const std::string& path, std::vector<Tree> trees, const ForestShape& shape) {
  cv::FileStorage file(path, cv::FileStorage::WRITE);
  if (!file.isOpened())
    throw InputError(path, "cannot be written", "give a file NAME.yml or NAME.yml.gz in an existing folder");
  make_equally_long(&trees);
  write_options(file, shape);
  write_rows(file, "childs", trees, [](const Tree& t) { return t.childs; });
  write_rows(file, "featureIds", trees, [](const Tree& t) { return t.feature_ids; });
  write_rows(file, "thresholds", trees, [](const Tree& t) { return t.thresholds; });
  write_answers(file, trees);
}

}  // namespace edgevo::training
