// SPDX-License-Identifier: BSD-3-Clause
#include "forest_model.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/persistence.hpp>
#include <stdexcept>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/opencv_bridge/quiet_opencv.h"
#include "opencv_error.h"

namespace edgevo {
namespace {

constexpr const char* kForestRemedy =
    "give a model in OpenCV's format for structured forests, as made by share/training";

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw InputError(where, what, kForestRemedy);
}

// Option by its name in the file, with its valid range: OpenCV's arithmetic does not overflow, and a frame
// takes neither minutes nor gigabytes. Published models have 2, 2, 32, 16, 4, 0, 2, 8, 4, 5, 4 to 8 and 4.
struct OptionRange {
  const char* name;
  int ForestOptions::*value;
  int least, most;
};
constexpr OptionRange kOptions[] = {
    {"stride", &ForestOptions::stride, 1, 64},
    {"shrinkNumber", &ForestOptions::shrinkNumber, 1, 8},
    {"patchSize", &ForestOptions::patchSize, 2, 128},
    {"patchInnerSize", &ForestOptions::patchInnerSize, 1, 128},
    {"numberOfGradientOrientations", &ForestOptions::numberOfGradientOrientations, 1, 16},
    {"gradientSmoothingRadius", &ForestOptions::gradientSmoothingRadius, 0, 32},
    {"regFeatureSmoothingRadius", &ForestOptions::regFeatureSmoothingRadius, 0, 32},
    {"ssFeatureSmoothingRadius", &ForestOptions::ssFeatureSmoothingRadius, 0, 32},
    {"gradientNormalizationRadius", &ForestOptions::gradientNormalizationRadius, 0, 32},
    {"selfsimilarityGridSize", &ForestOptions::selfsimilarityGridSize, 1, 8},
    {"numberOfTrees", &ForestOptions::numberOfTrees, 1, 64},
    {"numberOfTreesToEvaluate", &ForestOptions::numberOfTreesToEvaluate, 1, 64},
};

void check_options(const ForestOptions& o, const std::string& where) {
  for (const OptionRange& range : kOptions) {
    const int value = o.*range.value;
    if (value < range.least || value > range.most)
      refuse(where, std::string("options.") + range.name + " is " + std::to_string(value) + ", not between " +
                        std::to_string(range.least) + " and " + std::to_string(range.most));
  }
  const int border = o.patchSize - o.patchInnerSize;
  if (border < 0 || border % (2 * o.shrinkNumber) != 0 || o.patchSize % o.shrinkNumber != 0)
    refuse(where, "patchSize, patchInnerSize and shrinkNumber do not fit each other");
  if (o.stride > o.patchInnerSize) refuse(where, "options.stride is larger than patchInnerSize");
  if (o.numberOfTreesToEvaluate > o.numberOfTrees)
    refuse(where, "options.numberOfTreesToEvaluate is larger than numberOfTrees");
}

// Checks the cells that OpenCV compares with each other: all must lie in the patch.
void check_grid(const ForestOptions& o, const std::string& where) {
  const int side = o.patchSize / o.shrinkNumber, cells = o.selfsimilarityGridSize;
  const int half_cell = int(std::lrint(side / (2.0 * cells)));
  for (int i = 0; i < cells; ++i) {
    const int at = int((i + 1) * (side + 2 * half_cell - 1) / (cells + 1.0) - half_cell + 0.5f);
    if (at < 0 || at >= side) refuse(where, "options.selfsimilarityGridSize does not fit the patch");
  }
}

int feature_count(const ForestOptions& o) {
  const int side = o.patchSize / o.shrinkNumber, cells = o.selfsimilarityGridSize * o.selfsimilarityGridSize;
  return (side * side + cells * (cells - 1) / 2) * o.channels();
}

void check_tree(const ForestModel& m, size_t tree, const std::string& where) {
  const std::string name = "tree " + std::to_string(tree);
  const size_t nodes = m.childs[tree].size();
  if (nodes == 0 || nodes != m.childs[0].size())
    refuse(where, name + " does not have as many nodes as the first, or has none");
  if (m.featureIds[tree].size() != nodes || m.thresholds[tree].size() != nodes)
    refuse(where, name + ": childs, featureIds and thresholds are not of the same length");
  const int features = feature_count(m.options);
  for (size_t i = 0; i < nodes; ++i) {
    const std::string node = name + ", node " + std::to_string(i) + ": ";
    const int child = m.childs[tree][i], id = m.featureIds[tree][i];
    // Children come after their parent, so that every walk ends.
    if (child != 0 && (child < int(i) + 2 || child >= int(nodes)))
      refuse(where, node + "child " + std::to_string(child) + " is out of range");
    if (id < 0 || id >= features) refuse(where, node + "feature " + std::to_string(id) + " is out of range");
    if (!std::isfinite(m.thresholds[tree][i])) refuse(where, node + "the threshold is not a number");
  }
}

// OpenCV concatenates the rows.
std::vector<int> joined(const std::vector<std::vector<int>>& rows) {
  std::vector<int> all;
  for (const std::vector<int>& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

void check_edges(const ForestModel& m, const std::string& where) {
  const std::vector<int> boundaries = joined(m.edgeBoundaries), bins = joined(m.edgeBins);
  const size_t nodes = m.childs.size() * m.childs[0].size();
  if (boundaries.size() != nodes + 1)
    refuse(where, "has " + std::to_string(boundaries.size()) + " edgeBoundaries for " +
                      std::to_string(nodes) + " nodes, not one more");
  if (boundaries.front() < 0 || !std::is_sorted(boundaries.begin(), boundaries.end()) ||
      size_t(boundaries.back()) > bins.size())
    refuse(where, "edgeBoundaries do not ascend from 0 to the number of edgeBins");
  const int pixels = m.options.patchInnerSize * m.options.patchInnerSize * m.options.channels();
  for (const int bin : bins)
    if (bin < 0 || bin >= pixels) refuse(where, "edge bin " + std::to_string(bin) + " is out of range");
}

// ---- reading ----

cv::FileNode part(const cv::FileStorage& file, const char* name, const std::string& where) {
  const cv::FileNode node = file[name];
  if (!node.isSeq()) refuse(where, std::string("is not a structured forest: no list '") + name + "'");
  return node;
}

template <class T>
T number(const cv::FileNode& node, const char* name, const std::string& where) {
  const bool fits = node.isInt() || (std::is_floating_point_v<T> && node.isReal());
  if (!fits) refuse(where, std::string("a value of ") + name + " is missing or of another type");
  return T(node);
}

template <class T>
std::vector<std::vector<T>> rows(const cv::FileStorage& file, const char* name, const std::string& where) {
  std::vector<std::vector<T>> all;
  for (const cv::FileNode row : part(file, name, where)) {
    if (!row.isSeq()) refuse(where, std::string("a row of ") + name + " is not a list");
    all.emplace_back();
    for (const cv::FileNode value : row) all.back().push_back(number<T>(value, name, where));
  }
  return all;
}

ForestModel model_of(const cv::FileStorage& file, const std::string& where) {
  ForestModel m;
  const cv::FileNode options = file["options"];
  if (!options.isMap()) refuse(where, "is not a structured forest: no 'options'");
  for (const OptionRange& range : kOptions)
    m.options.*range.value = number<int>(options[range.name], range.name, where);
  m.childs = rows<int>(file, "childs", where);
  m.featureIds = rows<int>(file, "featureIds", where);
  m.thresholds = rows<float>(file, "thresholds", where);
  m.edgeBoundaries = rows<int>(file, "edgeBoundaries", where);
  m.edgeBins = rows<int>(file, "edgeBins", where);
  return m;
}

ForestModel open_forest(const std::string& file, int flags, const std::string& where) try {
  const QuietOpenCv quiet;
  const cv::FileStorage storage(file, flags);
  if (!storage.isOpened()) refuse(where, "is not a structured forest: it cannot be opened");
  return model_of(storage, where);
} catch (const cv::Exception& e) {
  refuse(where, "is not a structured forest: " + one_line(e));
} catch (const std::length_error&) {
  refuse(where,
         "is not a structured forest: a key in it is empty");  // OpenCV's YAML reader does not handle it
}

}  // namespace

void validate_forest(const ForestModel& m, const std::string& where) {
  check_options(m.options, where);
  check_grid(m.options, where);
  const size_t trees = size_t(m.options.numberOfTrees);
  if (m.childs.size() != trees || m.featureIds.size() != trees || m.thresholds.size() != trees)
    refuse(where, "childs, featureIds and thresholds do not have a row for each of " + std::to_string(trees) +
                      " trees");
  for (size_t tree = 0; tree < trees; ++tree) check_tree(m, tree, where);
  check_edges(m, where);
}

ForestModel parse_forest(const std::string& text, const std::string& where) {
  return open_forest(text, cv::FileStorage::READ | cv::FileStorage::MEMORY, where);
}

ForestModel read_forest(const std::string& path) {
  check_regular_file(path, kForestRemedy);
  const ForestModel model = open_forest(path, cv::FileStorage::READ, path);
  validate_forest(model, path);
  return model;
}

}  // namespace edgevo
