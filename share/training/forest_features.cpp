// SPDX-License-Identifier: BSD-3-Clause
#include "forest_features.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/structured_edge_detection.hpp>
#include <utility>
#include <vector>

namespace edgevo::training {
namespace {

// Triangular weights over 2 radius + 1 pixels, with sum 1.
std::vector<float> triangle(int radius) {
  if (radius == 1) return {0.25f, 0.5f, 0.25f};
  const float whole = float((radius + 1) * (radius + 1));
  std::vector<float> weights;
  for (int i = -radius; i <= radius; ++i) weights.push_back(float(radius + 1 - std::abs(i)) / whole);
  return weights;
}

cv::Mat smoothed(const cv::Mat& map, int radius) {
  if (radius == 0) return map;
  cv::Mat result;
  const std::vector<float> weights = triangle(radius);
  cv::sepFilter2D(map, result, -1, weights, weights);
  return result;
}

// Three equal channels of 0 to 1, as the detector receives a gray image, extended by the border of a patch
// around its centre.
cv::Mat as_colour(const cv::Mat& gray, int border) {
  cv::Mat colour, scaled, wide;
  cv::cvtColor(gray, colour, cv::COLOR_GRAY2RGB);
  colour.convertTo(scaled, CV_32F, 1.0 / 255.0);
  cv::copyMakeBorder(scaled, wide, border, border, border, border, cv::BORDER_REFLECT);
  return wide;
}

// Row and column of the cells of the grid, feature pixels: evenly spaced over the patch.
int cell_position(const ForestShape& s, int i) {
  const int half = cvRound(s.side() / (2.0 * s.grid));
  return int((i + 1) * (s.side() + 2 * half - 1) / (s.grid + 1.0) - half + 0.5f);
}

// The n-th pair (i < j) of `count` cells.
std::pair<int, int> nth_pair(int n, int count) {
  for (int i = 0;; n -= count - 1 - i, ++i)
    if (n < count - 1 - i) return {i, i + 1 + n};
}

}  // namespace

FeatureMaps::FeatureMaps(const cv::Mat& gray, const ForestShape& s) : shape_(s) {
  cv::Mat features;
  cv::ximgproc::createRFFeatureGetter()->getFeatures(as_colour(gray, s.border()), features,
                                                     s.gradient_normalisation, s.gradient_smoothing, s.shrink,
                                                     s.channels(), s.orientations);
  regular_ = smoothed(features, cvRound(float(s.regular_smoothing) / float(s.shrink)));
  similarity_ = smoothed(features, cvRound(float(s.similarity_smoothing) / float(s.shrink)));
  rows_ = cvCeil(double(features.rows * s.shrink - s.patch) / s.stride);
  cols_ = cvCeil(double(features.cols * s.shrink - s.patch) / s.stride);
}

float FeatureMaps::value(const cv::Mat& map, int row, int col, int y, int x, int channel) const {
  const int v = row * shape_.stride / shape_.shrink + y, u = col * shape_.stride / shape_.shrink + x;
  return map.ptr<float>(v)[u * shape_.channels() + channel];
}

// Ids ascend by channel, and within a channel column by column, as in OpenCV.
float FeatureMaps::at(int row, int col, int id) const {
  const int side = shape_.side(), grid = shape_.grid;
  if (id < shape_.plain_features()) {
    const int channel = id / (side * side), place = id % (side * side);
    return value(regular_, row, col, place % side, place / side, channel);
  }
  const int cells = grid * grid, pairs = cells * (cells - 1) / 2;
  const int channel = (id - shape_.plain_features()) / pairs;
  const auto [i, j] = nth_pair((id - shape_.plain_features()) % pairs, cells);
  const auto of_cell = [&](int cell) {
    return value(similarity_, row, col, cell_position(shape_, cell % grid),
                 cell_position(shape_, cell / grid), channel);
  };
  return of_cell(i) - of_cell(j);
}

}  // namespace edgevo::training
